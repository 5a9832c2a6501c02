#include "gpu/frame_copy.hpp"

#include <cstring>

namespace broadside::gpu {
namespace {

// Sections start where any of their types may.
constexpr std::size_t kAlignment = 256;

constexpr std::size_t aligned(std::size_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

core::Status PinnedBytes::reserve(std::size_t bytes) {
  if (memory_.host != nullptr && bytes <= capacity_) return core::Done{};
  release();
  auto memory = allocate_mapped_bytes(bytes);
  if (!memory.ok()) return memory.error();
  memory_ = memory.value();
  capacity_ = bytes;
  return core::Done{};
}

void PinnedBytes::release() {
  if (memory_.host != nullptr) release_mapped_bytes(memory_);
  memory_ = {};
  capacity_ = 0;
}

core::Status FrameCopy::start(const unsigned long long* digest_sum, const FrameBuffers* buffers,
                              const FrameCounts& counts, bool is_confirmed_by_level0, StreamHandle work,
                              StreamHandle copies) {
  is_full = buffers != nullptr;
  bytes_ = {};
  bytes_[0] = sizeof *digest_sum;
  if (is_full) {
    for (const std::size_t k : {1, 2, 3, 4}) bytes_[k] = counts.bodies * sizeof(PackedVec3);
    bytes_[5] = counts.bodies * sizeof(PackedBox);
    bytes_[6] = counts.pairs * sizeof(core::Pair);
    bytes_[7] = counts.confirmed * sizeof(core::Pair);
    bytes_[8] = counts.proximity * sizeof(core::Proximity);
    bytes_[9] = counts.contacts * sizeof(core::Contact);
    bytes_[10] = counts.face_contacts * sizeof(core::Contact);
  }
  std::size_t total = 0;
  for (std::size_t k = 0; k < kSections; ++k) {
    begin_[k] = total;
    total += aligned(bytes_[k]);
  }
  // A quarter more than asked for, so that frames that grow slowly do not allocate each time.
  if (total > device_.capacity()) {
    BROADSIDE_TRY(device_.reserve(total + total / 4, "a frame on its way to the host"));
    // What is between sections travels too.
    BROADSIDE_TRY(device_.fill_bytes(0));
    BROADSIDE_TRY(wait_for_device("clearing the copy of a frame"));
  }
  BROADSIDE_TRY(host_.reserve(device_.capacity()));

  BROADSIDE_TRY(add(0, digest_sum, bytes_[0], work));
  if (is_full) {
    BROADSIDE_TRY(add(1, buffers->state().position.data(), bytes_[1], work));
    BROADSIDE_TRY(add(2, buffers->state().velocity.data(), bytes_[2], work));
    BROADSIDE_TRY(add(3, buffers->detected().position.data(), bytes_[3], work));
    BROADSIDE_TRY(add(4, buffers->detected().velocity.data(), bytes_[4], work));
    BROADSIDE_TRY(add(5, buffers->boxes().data(), bytes_[5], work));
    BROADSIDE_TRY(add(6, buffers->pairs().data(), bytes_[6], work));
    const auto& confirmed = is_confirmed_by_level0 ? buffers->pairs() : buffers->confirmed();
    BROADSIDE_TRY(add(7, confirmed.data(), bytes_[7], work));
    BROADSIDE_TRY(add(8, buffers->proximity().data(), bytes_[8], work));
    BROADSIDE_TRY(add(9, buffers->contacts().data(), bytes_[9], work));
    BROADSIDE_TRY(add(10, buffers->face_contacts().data(), bytes_[10], work));
  }
  BROADSIDE_TRY(gathered_.set(work));
  BROADSIDE_TRY(gathered_.hold_back(copies));
  BROADSIDE_TRY(start_copy_to_host(host_.data(), device_.data(), total, copies));
  return arrived_.set(copies);
}

core::Status FrameCopy::add(std::size_t section, const void* from, std::size_t bytes, StreamHandle work) {
  if (bytes == 0) return core::Done{};
  return copy_on_device(device_.data() + begin_[section], from, bytes, work);
}

core::Status FrameCopy::finish(core::FrameRecord& frame) {
  BROADSIDE_TRY(arrived_.wait("copying a frame from the device"));
  unsigned long long digest = 0;
  std::memcpy(&digest, host_.data(), sizeof digest);
  frame.digest = digest;
  if (!is_full) return core::Done{};
  FrameArrays arrays;
  arrays.position = section<PackedVec3>(1);
  arrays.velocity = section<PackedVec3>(2);
  arrays.detected_position = section<PackedVec3>(3);
  arrays.detected_velocity = section<PackedVec3>(4);
  arrays.boxes = section<PackedBox>(5);
  arrays.pairs = section<core::Pair>(6);
  arrays.confirmed = section<core::Pair>(7);
  arrays.proximity = section<core::Proximity>(8);
  arrays.contacts = section<core::Contact>(9);
  arrays.face_contacts = section<core::Contact>(10);
  fill_record(arrays, frame);
  return core::Done{};
}

}  // namespace broadside::gpu
