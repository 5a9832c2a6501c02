// Each moved body's list of its patches, in no order.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"

namespace broadside::gpu {

// Reserves room for the list of each body, and marks all its colors as free.
template <typename Team>
__device__ void begin_lists(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    const std::uint32_t count = f.memory.count[i];
    f.memory.begin[i] =
        count == 0 ? 0
                   : static_cast<std::uint32_t>(atomicAdd(&f.counts->listed, static_cast<unsigned long long>(count)));
    f.memory.filled[i] = 0;
    f.coloring[i] = {};
  }
}

__device__ inline void list_patch(const RigidFrameView& f, std::uint32_t body, PatchEntry entry) {
  if (!is_moved(f, body)) return;
  f.memory.entries[f.memory.begin[body] + atomicAdd(&f.memory.filled[body], 1U)] = entry;
}

template <typename Team>
__device__ void fill_lists(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t k = team.rank(); k < f.counts->patches; k += team.size()) {
    const core::ContactPatch& patch = f.patches.items[k];
    const auto index = static_cast<std::uint32_t>(k);
    list_patch(f, patch.a, {index, patch.b});
    list_patch(f, patch.b, {index, patch.a});
  }
}

}  // namespace broadside::gpu
