// The launch after a search in mapped coordinates: it keeps the pairs that overlap as given
// (core/method/box_passes.hpp).
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

struct SettleView {
  // Indexed by the search's number of a box: the box as given. low_tag = the caller's number; high_tag: bit 0 = static,
  // then the group.
  const PackedBox* given = nullptr;
  std::uint32_t owned = 0;       // bit g: pairs within group g are kept here
  AppendView<core::Pair> found;  // pairs that the search found
  AppendView<core::Pair> pairs;  // pairs that are kept; demanded: Counters::confirmed
  Counters* counters = nullptr;  // of the search
  unsigned long long* barrier = nullptr;
  Outcome* outcome = nullptr;
};

core::Result<LaunchShape> settle_launch_shape();
// Asynchronous.
core::Status launch_settle(const SettleView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
