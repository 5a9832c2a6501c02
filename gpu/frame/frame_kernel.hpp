// Launches of the device code, as plain functions: the rest of gpu/ is compiled by the host compiler. frame_kernel.cu
// and pairs_kernel.cu implement them on CUDA, on_host/frame_on_host.cpp with fibers.
#pragma once

#include <cstdint>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/result.hpp"
#include "gpu/broad/bulk_view.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/grid_frame_view.hpp"
#include "gpu/frame/ring_shares.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// How many threads and blocks of a kernel this GPU can hold at once.
struct LaunchShape {
  std::uint32_t threads = 0;  // of a block; its number of warps is a power of two
  std::uint32_t blocks = 0;   // not more than are resident at once, since barriers wait for all of them
  std::uint32_t shared_bytes = 0;
  std::uint32_t multiprocessors = 0;

  [[nodiscard]] std::uint64_t all_threads() const { return std::uint64_t{blocks} * threads; }
};

// How many places of the ring of all bodies (stages/broad/body_ring.cuh) a warp takes at a time: the fewest for which
// there are warps enough, so that a warp seldom has to test the levels of two pairs one after the other.
inline std::uint32_t ring_share(std::uint32_t bodies, const LaunchShape& shape) {
  const std::uint64_t warps = shape.all_threads() / 32;
  std::uint32_t share = 1;
  while (share < 32 && std::uint64_t{bodies} * ring_shares(bodies, share) > warps) ++share;
  return share;
}

// Above this many bodies the tiles of tile_stage.cuh are faster: there a warp tests 1024 pairs, in small frames 32.
constexpr std::uint32_t kMostSmallBodies = 512;

// Whether frames with this start are small frames. The kernel of small frames has no other start and no other solver,
// and in its response one block has a thread for each body.
inline bool is_small_frame(const FrameView& f, Start start) {
  return start == Start::kTiles && f.body_count <= kMostSmallBodies && f.body_count <= f.block_bodies &&
         f.solver == Solver::kColored;
}

// The shape for vertex trees of this many levels. An error says that the GPU has too little shared memory for one
// warp's stack.
core::Result<LaunchShape> frame_launch_shape(std::uint32_t tree_levels);

// One launch runs a whole frame, since every stage reads its counts on the device. Asynchronous.
core::Status launch_frame(const SmallFrameView& frame, const LaunchShape& shape, StreamHandle stream);
core::Status launch_frame(const GridFrameView& frame, const LaunchShape& shape, StreamHandle stream);

// The broad phase alone, by the same rules. If bulk pairs have enough boxes, a launch before this one sorts them.
struct PairsView {
  std::uint32_t box_count = 0;
  const PackedBox* boxes = nullptr;  // low_tag = body, high_tag: 1 = static
  BroadView broad;
  BulkView bulk;  // where the start is Start::kBulk
  AppendView<core::Pair> pairs;
  Counters* counters = nullptr;
  unsigned long long* barrier = nullptr;  // the barrier word
  Outcome* outcome = nullptr;
};
// When bulk pairs are put in order by bins, and how.
struct BinLimits {
  std::uint32_t least_boxes = 0;
  std::uint32_t most_at_once = 0;  // the most bins that a tile counts; 0: as many as fit
};
struct PairsShape {
  LaunchShape search;
  LaunchShape sort;  // where there are bins
  BinsShape bins;    // none also if the GPU has too little shared memory for them
};
core::Result<PairsShape> pairs_launch_shape(Start start, std::uint32_t boxes, std::uint32_t buckets,
                                            const BinLimits& limits);
core::Status launch_pairs(const PairsView& view, const PairsShape& shape, StreamHandle stream);

// The sum of the digests of everything that the last frame left. The kernel reads counts on the device, so it can be
// launched right after the frame. A frame that was aborted has no digest. Asynchronous.
struct DigestView {
  std::uint32_t body_count = 0;
  StateView state;
  const core::Quat* orientation = nullptr;
  const core::Pair* confirmed = nullptr;
  bool is_confirmed_by_level0 = false;
  const core::Contact* contacts = nullptr;
  const core::Contact* face_contacts = nullptr;
  Counters* counters = nullptr;
  unsigned long long* digest = nullptr;  // the result, in host memory
};
core::Status launch_digest(const DigestView& view, std::uint32_t multiprocessors, StreamHandle stream);

}  // namespace broadside::gpu
