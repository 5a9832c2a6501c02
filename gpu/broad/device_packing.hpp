// Packs boxes that lie on the device already, and learns there what the host would have learned of them.
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

// Of sound boxes.
BoxFacts facts_of(const BoxMeasure& measure, std::uint32_t count);

class DevicePacking {
 public:
  // Before the first boxes with these flags.
  void start() { has_flags_ = false; }

  // What the stream is asked for from now on comes after what may still write these boxes.
  core::Status wait_behind(const core::DeviceBoxes& given, const Stream& stream);

  // Waits: when it returns the boxes were read, and are in `to` with these flags. An error names the first that is no
  // box. `is_static`: of as many boxes.
  core::Result<BoxFacts> pack(const core::DeviceBoxes& given, std::span<const std::uint8_t> is_static, PackedBox* to,
                              const Stream& stream);

  // Waits. Those of the boxes, which are not packed for it.
  core::Result<std::vector<core::Box>> gather(const core::DeviceBoxes& given, std::span<const std::uint32_t> which,
                                              const Stream& stream);

 private:
  core::Status reserve(std::span<const std::uint8_t> is_static);

  DeviceBuffer<std::uint8_t> flags_;
  DeviceBuffer<BoxMeasure> measures_;  // that of no box, which each packing begins with, and that of the last boxes
  Mapped<BoxMeasure, 1> measured_;
  DeviceBuffer<std::uint32_t> which_;
  DeviceBuffer<core::Box> gathered_;
  StreamMark written_;
  bool has_flags_ = false;  // and the measure of no box
};

}  // namespace broadside::gpu
