// The search of bulk pairs with four lanes for each box. It is for boxes so few that most warps take boxes only once,
// and so crowded that some warps would have most of the work. pairs_kernel.cu and on_host/frame_on_host.cpp implement
// it.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// How many lanes look for the partners of one box where boxes are crowded: fitted_cells.hpp.
constexpr std::uint32_t kLanesOfCrowd = 4;

// As pairs_launch_shape and launch_pairs, for Start::kBulk. `lanes_per_box`: 1 or kLanesOfCrowd, the same in both.
core::Result<PairsShape> bulk_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits,
                                           std::uint32_t lanes_per_box);
core::Status launch_bulk(const PairsView& view, const PairsShape& shape, std::uint32_t lanes_per_box,
                         StreamHandle stream);

}  // namespace broadside::gpu
