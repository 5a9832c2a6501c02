// Copies one frame from the device into a record while the device computes the next one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "gpu/frame/frame_buffers.hpp"
#include "gpu/frame/frame_record.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// Pinned memory of the host, with an owner.
class PinnedBytes {
 public:
  PinnedBytes() = default;
  PinnedBytes(const PinnedBytes&) = delete;
  PinnedBytes& operator=(const PinnedBytes&) = delete;
  ~PinnedBytes() { release(); }
  // Contents are lost when it grows.
  core::Status reserve(std::size_t bytes);
  [[nodiscard]] std::byte* data() const { return static_cast<std::byte*>(memory_.host); }

 private:
  void release();
  MappedMemory memory_;
  std::size_t capacity_ = 0;
};

// First the stream that computes copies the frame's arrays, side by side, to memory of their own on the device; from
// there a second stream copies them to the host. So the next frame may overwrite the buffers at once.
class FrameCopy {
 public:
  // Returns at once. A copy that was started must be finished before the next one starts here.
  core::Status start(const FrameBuffers& buffers, const FrameCounts& counts, bool is_confirmed_by_level0,
                     StreamHandle work, StreamHandle copies);
  // Waits for the copy, and fills what fill_record fills.
  core::Status finish(core::FrameRecord& frame);

  // What the host knows of the frame already: step, time, digest, counts. If the frame is not recorded in full, that is
  // all, and nothing is copied.
  core::FrameRecord begun;
  bool has_digest = false;  // the digest may come later than the rest
  bool is_full = false;

 private:
  static constexpr std::size_t kSections = 10;
  core::Status add(std::size_t section, const void* from, StreamHandle work);
  template <typename T>
  [[nodiscard]] std::span<const T> section(std::size_t k) const {
    return {reinterpret_cast<const T*>(host_.data() + begin_[k]), bytes_[k] / sizeof(T)};
  }

  DeviceBuffer<std::byte> device_;
  PinnedBytes host_;
  std::array<std::size_t, kSections> begin_{};
  std::array<std::size_t, kSections> bytes_{};
  StreamMark gathered_;
  StreamMark arrived_;
};

}  // namespace broadside::gpu
