// Packs boxes that lie on the device already, and finds the facts about them that the host needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/device_boxes.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/broad/pack_view.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"

namespace broadside::gpu {

// The boxes must be sound.
BoxFacts facts_of(const BoxMeasure& measure, std::uint32_t count);

class DevicePacking {
 public:
  // Call it before the first boxes with these flags.
  void start() { has_flags_ = false; }

  // Work that is put into the stream from now on begins after any work that may still write these boxes.
  core::Status wait_behind(const core::DeviceBoxes& given, const Stream& stream);

  // Waits: when it returns, the boxes were read and are in `to` with these flags. An error names the first one that is
  // not a box. `is_static` must have as many flags.
  core::Result<BoxFacts> pack(const core::DeviceBoxes& given, std::span<const std::uint8_t> is_static, PackedBox* to,
                              const Stream& stream);

  // Waits. Returns these boxes; they need not be packed for it.
  core::Result<std::vector<core::Box>> gather(const core::DeviceBoxes& given, std::span<const std::uint32_t> which,
                                              const Stream& stream);

 private:
  core::Status reserve(std::span<const std::uint8_t> is_static);

  DeviceBuffer<std::uint8_t> flags_;
  DeviceBuffer<BoxMeasure> measures_;  // [0]: of no box, with which each packing begins; [1]: of the last boxes
  Mapped<BoxMeasure, 1> measured_;
  DeviceBuffer<std::uint32_t> which_;
  DeviceBuffer<core::Box> gathered_;
  StreamMark written_;
  bool has_flags_ = false;  // and whether measures_[0] is there
};

}  // namespace broadside::gpu
