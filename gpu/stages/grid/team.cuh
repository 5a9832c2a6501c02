// Teams: the threads that work on a stage together. A team is the whole grid, its first blocks, or one block.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

constexpr unsigned kFullWarp = 0xFFFFFFFFU;

// The grid of a kernel that has no barrier.
struct GridPlaces {
  __device__ std::uint64_t rank() const { return std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; }
  // Another numbering of threads: the first warp of every block, then the second warp of every block, and so on. So few
  // items are still spread over all multiprocessors.
  __device__ std::uint64_t spread_rank() const {
    return (std::uint64_t{threadIdx.x / 32} * gridDim.x + blockIdx.x) * 32 + threadIdx.x % 32;
  }
  __device__ std::uint64_t size() const { return std::uint64_t{gridDim.x} * blockDim.x; }
};

// sync() waits for all threads of the grid and makes their writes visible. All blocks must be resident together: a
// cooperative launch, or one of dependent_launch.cuh.
class GridTeam : public GridPlaces {
 public:
  // `barrier`: the word of GridBarrier.
  __device__ explicit GridTeam(unsigned long long* barrier) : barrier_(barrier) {}
  __device__ void sync() const { barrier_.sync(); }
  // The same; returns the tally.
  __device__ unsigned long long sync_and_read(unsigned long long* in_block) const {
    return barrier_.sync_and_read(in_block);
  }

 private:
  mutable GridBarrier barrier_;
};

struct BlockTeam {
  __device__ std::uint64_t rank() const { return threadIdx.x; }
  __device__ std::uint64_t spread_rank() const { return threadIdx.x; }
  __device__ std::uint64_t lonely_rank() const { return threadIdx.x; }
  __device__ std::uint64_t size() const { return blockDim.x; }
  __device__ void sync() const { __syncthreads(); }
};

// The first blocks of a grid whose other blocks have ended, since a barrier of fewer blocks is faster. `arrived` starts
// at zero and counts all arrivals of the launch.
struct PartialGridTeam {
  std::uint32_t blocks = 1;
  std::uint32_t* arrived = nullptr;
  mutable std::uint32_t syncs = 0;

  __device__ std::uint64_t rank() const { return std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; }
  // As in GridPlaces.
  __device__ std::uint64_t spread_rank() const {
    return (std::uint64_t{threadIdx.x / 32} * blocks + blockIdx.x) * 32 + threadIdx.x % 32;
  }
  // A third numbering: the first lane of every warp, then the second lane of every warp, and so on. As long as there
  // are enough warps, each has only one thread with a body, so no chain of contacts waits for other lanes of its warp.
  __device__ std::uint64_t lonely_rank() const {
    const std::uint64_t warps = std::uint64_t{blocks} * (blockDim.x / 32);
    return threadIdx.x % 32 * warps + std::uint64_t{threadIdx.x / 32} * blocks + blockIdx.x;
  }
  __device__ std::uint64_t size() const { return std::uint64_t{blocks} * blockDim.x; }
  __device__ void sync() const {
    ++syncs;
    __syncthreads();
    if (threadIdx.x == 0) arrive_and_wait(arrived, syncs * blocks);
    __syncthreads();
  }
};

// The place of a warp among those that share a piece of work.
struct WarpShare {
  std::uint32_t member = 0;
  std::uint32_t members = 1;

  __device__ bool is_last() const { return member == members - 1; }
};

template <typename Team>
__device__ std::uint64_t warp_rank(const Team& team) {
  return team.rank() / 32;
}
template <typename Team>
__device__ std::uint64_t warp_count(const Team& team) {
  return team.size() / 32;
}
__device__ inline unsigned lane() {
  return threadIdx.x % 32;
}

// Call it between the loads of a whole warp and the first use of any loaded word, so that the warp waits only once.
// Without it the compiler, to use fewer registers, waits for one word before it loads the next. It works because the
// compiler moves no access past a barrier of the warp.
__device__ inline void group_loads() {
  __syncwarp();
}

// Reserves `count` places for a whole warp; returns the first.
__device__ inline std::uint32_t room_for_warp(std::uint32_t count, std::uint32_t* taken) {
  std::uint32_t first = 0;
  if (lane() == 0) first = atomicAdd(taken, count);
  return __shfl_sync(kFullWarp, first, 0);
}
// The same with one place for each of these lanes; returns this lane's.
__device__ inline std::uint32_t place_in_warp(unsigned lanes, std::uint32_t* taken) {
  return room_for_warp(__popc(lanes), taken) + __popc(lanes & ((1U << lane()) - 1U));
}

// Reserves room for the items of one warp in an append buffer, with one atomic for all its lanes. Called by whole
// warps. Returns the place of this lane's first item. Places at or past the capacity are counted, but must not be
// written.
template <typename Count>
__device__ Count warp_append(unsigned count, Count* demanded) {
  unsigned before = count;
  for (unsigned step = 1; step < 32; step *= 2) {
    const unsigned other = __shfl_up_sync(kFullWarp, before, step);
    if (lane() >= step) before += other;
  }
  const unsigned total = __shfl_sync(kFullWarp, before, 31);
  before -= count;
  if (total == 0) return 0;
  Count base = 0;
  if (lane() == 0) base = atomicAdd(demanded, static_cast<Count>(total));
  return __shfl_sync(kFullWarp, base, 0) + before;
}

// The same for lanes that have one item or none.
template <typename Count>
__device__ Count warp_append_one(bool has_one, Count* demanded) {
  const unsigned with = __ballot_sync(kFullWarp, has_one);
  if (with == 0) return 0;
  Count base = 0;
  if (lane() == 0) base = atomicAdd(demanded, static_cast<Count>(__popc(with)));
  return __shfl_sync(kFullWarp, base, 0) + static_cast<Count>(__popc(with & ((1U << lane()) - 1U)));
}

}  // namespace broadside::gpu
