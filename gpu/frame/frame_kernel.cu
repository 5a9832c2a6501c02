#include <algorithm>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/digest.cuh"
#include "gpu/stages/grid/dependent_launch.cuh"
#include "gpu/stages/grid_frame.cuh"
#include "gpu/stages/small_frame.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 512;
static_assert(kThreads <= kMaxBlockWarps * 32);
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;
constexpr std::uint32_t kSmallBlocksPerMultiprocessor = 1;  // not more, so that a thread has enough registers
constexpr std::uint32_t kDigestThreads = 512;
constexpr std::uint32_t kDigestBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kThreads, kSmallBlocksPerMultiprocessor)
    small_frame_kernel(const __grid_constant__ SmallFrameView frame) {
  extern __shared__ __align__(16) unsigned char shared[];
  __shared__ SmallScratch scratch;
  run_small_frame(frame, scratch, shared);
}

template <bool kHasThreadPerBody>
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    grid_frame_kernel(const __grid_constant__ GridFrameView frame) {
  extern __shared__ __align__(16) unsigned char shared[];
  __shared__ GridScratch scratch;
  run_grid_frame<kHasThreadPerBody>(frame, scratch, shared);
}

__global__ void __launch_bounds__(kDigestThreads, kDigestBlocksPerMultiprocessor)
    digest_kernel(const __grid_constant__ DigestView view) {
  __shared__ unsigned long long block_sum;
  run_digest(view, &block_sum);
}

// A small frame's kernel also keeps shapes in shared memory.
LaunchShape small_shape(LaunchShape shape) {
  shape.shared_bytes += sizeof(BlockShapes);
  return shape;
}

LaunchBegin small_begin() {
  static const bool can_be = can_be_dependent(reinterpret_cast<const void*>(small_frame_kernel));
  return can_be ? LaunchBegin::kDependent : LaunchBegin::kTogether;
}

}  // namespace

core::Result<LaunchShape> frame_launch_shape(std::uint32_t tree_levels) {
  auto is_cooperative = attribute(cudaDevAttrCooperativeLaunch);
  if (!is_cooperative.ok()) return is_cooperative.error();
  if (is_cooperative.value() == 0)
    return core::Error{"this GPU cannot launch cooperative kernels", "octree-gpu",
                       "use one of compute capability 7.5 or later", core::Exit::kMissing};
  auto block_limit = attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin);
  if (!block_limit.ok()) return block_limit.error();
  const std::uint32_t bytes_per_warp = std::max(stack_entries_of(tree_levels) * kBytesPerStackEntry,
                                                static_cast<std::uint32_t>((sizeof(PairQueue) + 15) / 16 * 16));
  for (std::uint32_t threads = kThreads; threads >= 32; threads /= 2) {
    LaunchShape shape{threads, 0, threads / 32 * bytes_per_warp, 0};
    LaunchShape small = small_shape(shape);
    if (small.shared_bytes + std::max(sizeof(SmallScratch), sizeof(GridScratch)) > block_limit.value()) continue;
    LaunchShape other = shape;
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(grid_frame_kernel<true>), shape));
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(grid_frame_kernel<false>), other));
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(small_frame_kernel), small));
    shape.blocks = std::min(shape.blocks, other.blocks);
    // A small frame gets one block a multiprocessor.
    if (shape.blocks != 0 && small.blocks >= small.multiprocessors) return shape;
  }
  return core::Error{"this GPU has too little shared memory for the vertex trees' stack", "octree-gpu",
                     "use a mesh of fewer vertices", core::Exit::kMissing};
}

core::Status launch_frame(const SmallFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(small_frame_kernel, frame, small_shape(shape), stream, small_begin());
}

core::Status launch_frame(const GridFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  const bool has_thread_per_body = frame.body_count <= shape.all_threads();
  return launch(has_thread_per_body ? grid_frame_kernel<true> : grid_frame_kernel<false>, frame, shape, stream);
}

core::Status launch_digest(const DigestView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  // The host does not know yet how many contacts there are. A heap has some seven a body.
  const std::uint32_t blocks =
      std::clamp(view.body_count / (kDigestThreads / 8), 1U, kDigestBlocksPerMultiprocessor * multiprocessors);
  digest_kernel<<<blocks, kDigestThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the digest");
}

}  // namespace broadside::gpu
