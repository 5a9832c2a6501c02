// The digest of a frame, computed by a kernel of its own after the frame's, because the frame's kernel has no registers
// to spare.
#pragma once

#include "core/method/frame_digest.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/contact_words.cuh"

namespace broadside::gpu {

// `block_sum` lies in the block's shared memory. The last block to add its sum writes the digest for the host.
__device__ inline void run_digest(const DigestView& view, unsigned long long* block_sum) {
  Counters& counters = *view.counters;
  if (counters.is_aborted != 0) return;
  if (threadIdx.x == 0) *block_sum = 0;
  __syncthreads();
  const GridPlaces grid;
  unsigned long long sum = 0;
  for (std::uint64_t i = grid.rank(); i < view.body_count; i += grid.size())
    sum += core::body_digest(static_cast<std::uint32_t>(i), view.state.position[i].v, view.orientation[i],
                             view.state.velocity[i].v, core::Vec3{});
  const std::uint64_t confirmed = view.is_confirmed_by_level0 ? counters.pairs : counters.confirmed;
  // If all confirmed pairs touch, they are the pairs of the contacts and need not be loaded.
  const bool all_touch = counters.touching == confirmed;
  if (!all_touch)
    for (std::uint64_t k = grid.rank(); k < confirmed; k += grid.size())
      sum += core::confirmed_digest(view.confirmed[k]);
  for (std::uint64_t k = grid.rank(); k < counters.touching; k += grid.size()) {
    const core::Contact contact = load_contact_once(view.contacts + k);
    if (all_touch) sum += core::confirmed_digest({contact.a, contact.b});
    if (contact.depth_m > 0.0F) sum += core::contact_digest(contact);
  }
  for (std::uint64_t k = grid.rank(); k < counters.faces; k += grid.size())
    sum += core::contact_digest(load_contact_once(view.face_contacts + k));

  for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(kFullWarp, sum, step);
  if (lane() == 0 && sum != 0) atomicAdd(block_sum, sum);
  __syncthreads();
  if (threadIdx.x != 0) return;
  atomicAdd(&counters.digest, *block_sum);
  if (arrive(&counters.digested) + 1 == gridDim.x) *view.digest = atomicAdd(&counters.digest, 0ULL);
}

}  // namespace broadside::gpu
