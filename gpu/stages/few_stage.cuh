// All pairs of a few bodies: level 0 and the levels below it at once, without a barrier between them. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/body_ring.cuh"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/fetched.cuh"
#include "gpu/stages/pair_queue.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Above this the tiles of tile_stage.cuh are sooner done: a warp of theirs tests 1024 pairs, one of ours 32.
constexpr std::uint32_t kFewBodies = 512;

// Whether frames are those of the kernel for few bodies, which knows nothing else and has a thread for each.
inline bool has_few_bodies(const FrameView& f, std::uint64_t threads) {
  return f.broad.start == Start::kTiles && f.body_count <= kFewBodies && f.body_count <= threads &&
         f.solver == Solver::kColored;
}

// The octrees of all shapes in a block's shared memory. They are asked for while bodies are integrated, and waited for
// where a pair goes down the levels.
class OctreesInBlock {
 public:
  __device__ OctreesInBlock(const FrameView& f, unsigned char* shared, BlockCopy& copy)
      : boxes_(reinterpret_cast<PackedBox*>(shared)),
        copy_(copy),
        bytes_(f.shapes.count * core::kBodyOctreeNodes * sizeof(PackedBox)),
        // Where there is room for them, and somebody needs them.
        are_there_(f.levels != core::Levels::kFlat && bytes_ <= blockDim.x / 32 * sizeof(PairQueue)) {}

  __device__ bool are_there() const { return are_there_; }
  // By all threads of the block; one warp does it. Between the two the block meets, and nobody uses `shared` for
  // anything else.
  __device__ void begin(const FrameView& f) const {
    if (are_there_ && is_ours()) copy_.begin(boxes_, f.shapes.octree, bytes_);
  }
  __device__ void end() const {
    if (are_there_ && is_ours()) copy_.wait();
  }

  __device__ void wait() const { copy_.wait(); }
  __device__ core::Box at(std::uint32_t k) const { return fetched(boxes_ + k); }

 private:
  // Neither the first warp, which meets for the block, nor the last, which has bodies.
  __device__ static bool is_ours() { return threadIdx.x / 32 == blockDim.x / 64; }

  PackedBox* boxes_;
  BlockCopy& copy_;
  std::uint32_t bytes_;
  bool are_there_;
};

// What few bodies' pairs come to: both counts in one word, so that one atomic takes room in both lists.
struct FewCounts {
  std::uint32_t pairs = 0;
  std::uint32_t confirmed = 0;

  __device__ unsigned long long packed() const { return pairs | std::uint64_t{confirmed} << 32U; }
  __device__ static FewCounts unpacked(unsigned long long word) {
    return {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32U)};
  }
};

// A warp's first item, and what of it does not move: known before the bodies do.
struct FewStart {
  BodyRing<std::uint32_t> ring;
  std::uint32_t item = 0;
  BodyRing<std::uint32_t>::Meeting meeting;
  std::uint32_t shape_i = 0;
  std::uint32_t shape_j = 0;

  __device__ FewStart(const GridTeam& team, const FrameView& f)
      : ring(f.body_count, f.ring_share), item(static_cast<std::uint32_t>(team.spread_rank() / 32)) {
    if (item < ring.items()) enter(f);
  }

  __device__ bool next(const FrameView& f, std::uint32_t stride) {
    item += stride;
    if (item >= ring.items()) return false;
    enter(f);
    return true;
  }

 private:
  __device__ void enter(const FrameView& f) {
    meeting = ring.meeting(item);
    shape_i = f.shape_of_body[meeting.i];
    shape_j = f.shape_of_body[meeting.j];
  }
};

template <typename Octrees>
__device__ void find_and_confirm_few(const GridTeam& team, const FrameView& f, FewStart at, const Octrees& octrees) {
  if (at.item >= at.ring.items()) return;
  Uncounted work;
  const auto stride = static_cast<std::uint32_t>(warp_count(team));
  do {
    // Everything is asked for before any of it is looked at: one wait.
    const PackedBox box_i = f.boxes[at.meeting.i];
    const PackedBox box_j = f.boxes[at.meeting.j];
    const PlacedShape placed_i{at.shape_i, f.detected.position[at.meeting.i].v};
    const PlacedShape placed_j{at.shape_j, f.detected.position[at.meeting.j].v};
    const bool overlaps =
        at.meeting.exists && core::overlaps(unpack(box_i), unpack(box_j)) && (box_i.high_tag & box_j.high_tag) == 0;
    const unsigned found = __ballot_sync(kFullWarp, overlaps);
    if (found == 0) continue;
    octrees.wait();
    unsigned confirmed = 0;
    for (unsigned left = f.levels == core::Levels::kFlat ? 0U : found; left != 0; left &= left - 1) {
      const int source = __ffs(static_cast<int>(left)) - 1;
      const PlacedShape other{
          __shfl_sync(kFullWarp, placed_j.shape, source),
          {__shfl_sync(kFullWarp, placed_j.x.x, source), __shfl_sync(kFullWarp, placed_j.x.y, source),
           __shfl_sync(kFullWarp, placed_j.x.z, source)}};
      if (are_levels_overlapping<2>(f, octrees, placed_i, other, work)) confirmed |= 1U << source;
    }
    // Room in both lists with one atomic: one wait.
    unsigned long long room = 0;
    if (lane() == 0)
      room = atomicAdd(
          &f.counters->few,
          FewCounts{static_cast<std::uint32_t>(__popc(found)), static_cast<std::uint32_t>(__popc(confirmed))}.packed());
    const FewCounts first = FewCounts::unpacked(__shfl_sync(kFullWarp, room, 0));
    const core::Pair pair = core::make_pair_of(at.meeting.i, at.meeting.j);
    const auto enter = [&pair](unsigned lanes, std::uint32_t place, const AppendView<core::Pair>& out) {
      place += __popc(lanes & ((1U << lane()) - 1U));
      if ((lanes >> lane() & 1U) != 0 && place < out.capacity) out.items[place] = pair;
    };
    enter(found, first.pairs, f.pairs);
    enter(confirmed, first.confirmed, f.confirmed);
  } while (at.next(f, stride));
}

}  // namespace broadside::gpu
