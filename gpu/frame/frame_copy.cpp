#include "gpu/frame/frame_copy.hpp"

#include <algorithm>

namespace broadside::gpu {
namespace {

// Sections start at multiples of this, which is enough for any of their types.
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

core::Status FrameCopy::start(const FrameBuffers& buffers, const FrameCounts& counts, bool is_confirmed_by_level0,
                              StreamHandle work, StreamHandle copies) {
  for (const std::size_t k : {0, 1, 2, 3}) bytes_[k] = counts.bodies * sizeof(PackedVec3);
  bytes_[4] = counts.bodies * sizeof(PackedBox);
  bytes_[5] = counts.pairs * sizeof(core::Pair);
  bytes_[6] = counts.confirmed * sizeof(core::Pair);
  bytes_[7] = counts.proximity * sizeof(core::Proximity);
  bytes_[8] = counts.contacts * sizeof(core::Contact);
  bytes_[9] = counts.face_contacts * sizeof(core::Contact);
  std::size_t total = 0;
  for (std::size_t k = 0; k < kSections; ++k) {
    begin_[k] = total;
    total += aligned(bytes_[k]);
  }
  total = std::max(total, kAlignment);  // a scene without bodies has nothing to copy
  // A quarter more than asked for, so that frames that grow slowly do not allocate each time.
  if (total > device_.capacity()) {
    BROADSIDE_TRY(device_.reserve(total + total / 4, "a frame on its way to the host"));
    // The gaps between sections are copied too, so they must be initialized.
    BROADSIDE_TRY(device_.fill_bytes(0));
    BROADSIDE_TRY(wait_for_device("clearing the copy of a frame"));
  }
  BROADSIDE_TRY(host_.reserve(device_.capacity()));

  BROADSIDE_TRY(add(0, buffers.state().position.data(), work));
  BROADSIDE_TRY(add(1, buffers.state().velocity.data(), work));
  BROADSIDE_TRY(add(2, buffers.detected().position.data(), work));
  BROADSIDE_TRY(add(3, buffers.detected().velocity.data(), work));
  BROADSIDE_TRY(add(4, buffers.boxes().data(), work));
  BROADSIDE_TRY(add(5, buffers.pairs().data(), work));
  const auto& confirmed = is_confirmed_by_level0 ? buffers.pairs() : buffers.confirmed();
  BROADSIDE_TRY(add(6, confirmed.data(), work));
  BROADSIDE_TRY(add(7, buffers.proximity().data(), work));
  BROADSIDE_TRY(add(8, buffers.contacts().data(), work));
  BROADSIDE_TRY(add(9, buffers.face_contacts().data(), work));
  BROADSIDE_TRY(gathered_.set(work));
  BROADSIDE_TRY(gathered_.hold_back(copies));
  BROADSIDE_TRY(start_copy_to_host(host_.data(), device_.data(), total, copies));
  return arrived_.set(copies);
}

core::Status FrameCopy::add(std::size_t section, const void* from, StreamHandle work) {
  if (bytes_[section] == 0) return core::Done{};
  return copy_on_device(device_.data() + begin_[section], from, bytes_[section], work);
}

core::Status FrameCopy::finish(core::FrameRecord& frame) {
  BROADSIDE_TRY(arrived_.wait("copying a frame from the device"));
  FrameArrays arrays;
  arrays.position = section<PackedVec3>(0);
  arrays.velocity = section<PackedVec3>(1);
  arrays.detected_position = section<PackedVec3>(2);
  arrays.detected_velocity = section<PackedVec3>(3);
  arrays.boxes = section<PackedBox>(4);
  arrays.pairs = section<core::Pair>(5);
  arrays.confirmed = section<core::Pair>(6);
  arrays.proximity = section<core::Proximity>(7);
  arrays.contacts = section<core::Contact>(8);
  arrays.face_contacts = section<core::Contact>(9);
  fill_record(arrays, frame);
  return core::Done{};
}

}  // namespace broadside::gpu
