#include <algorithm>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/digest.cuh"
#include "gpu/stages/frame.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 512;
static_assert(kThreads <= kMaxBlockWarps * 32);
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;
constexpr std::uint32_t kFewBlocksPerMultiprocessor = 1;  // few bodies get no more, so that registers suffice
constexpr std::uint32_t kDigestThreads = 512;
constexpr std::uint32_t kDigestBlocksPerMultiprocessor = 2;

template <FrameKind kKind>
__global__ void __launch_bounds__(kThreads,
                                  kKind == FrameKind::kFew ? kFewBlocksPerMultiprocessor : kBlocksPerMultiprocessor)
    frame_kernel(const __grid_constant__ FrameView frame) {
  extern __shared__ __align__(16) unsigned char shared[];
  __shared__ BlockScratch scratch;
  run_frame<kKind>(frame, scratch, shared);
}

__global__ void __launch_bounds__(kDigestThreads, kDigestBlocksPerMultiprocessor)
    digest_kernel(const __grid_constant__ DigestView view) {
  __shared__ unsigned long long block_sum;
  run_digest(view, &block_sum);
}

// Few bodies' kernel has shapes in shared memory too.
LaunchShape few_shape(LaunchShape shape) {
  shape.shared_bytes += sizeof(BlockShapes);
  return shape;
}

// Of few bodies' frames, all of whose blocks but one end early. Not where processes share the GPU side by side (MPS):
// nobody knows what else waits for its blocks there. And only if the kernel waits for the one before, which is a matter
// of what it was compiled for, not of the GPU: this may have made its code of what was meant for an older one.
LaunchBegin few_begin() {
  static const bool can_be_early = [] {
    cudaFuncAttributes kernel = {};
    const auto shares = attribute(cudaDevAttrMpsEnabled);
    return shares.ok() && shares.value() == 0 &&
           cudaFuncGetAttributes(&kernel, reinterpret_cast<const void*>(frame_kernel<FrameKind::kFew>)) ==
               cudaSuccess &&
           kernel.ptxVersion >= 90;
  }();
  return can_be_early ? LaunchBegin::kEarly : LaunchBegin::kTogether;
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
    if (few_shape(shape).shared_bytes + sizeof(BlockScratch) > block_limit.value()) continue;
    LaunchShape few = few_shape(shape);
    LaunchShape many = shape;
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(frame_kernel<FrameKind::kSome>), shape));
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(frame_kernel<FrameKind::kMany>), many));
    BROADSIDE_TRY(fit(reinterpret_cast<const void*>(frame_kernel<FrameKind::kFew>), few));
    shape.blocks = std::min(shape.blocks, many.blocks);
    // Few bodies get one block a multiprocessor.
    if (shape.blocks != 0 && few.blocks >= few.multiprocessors) return shape;
  }
  return core::Error{"this GPU has too little shared memory for the vertex trees' stack", "octree-gpu",
                     "use a mesh of fewer vertices", core::Exit::kMissing};
}

core::Status launch_frame(const FrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  void (*const kernels[])(FrameView) = {frame_kernel<FrameKind::kFew>, frame_kernel<FrameKind::kSome>,
                                        frame_kernel<FrameKind::kMany>};
  const FrameKind kind = kind_of(frame, shape.all_threads());
  const auto kernel = kernels[static_cast<std::size_t>(kind)];
  if (kind == FrameKind::kFew) return launch(kernel, frame, few_shape(shape), stream, few_begin());
  return launch(kernel, frame, shape, stream);
}

core::Status launch_digest(const DigestView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  // Of contacts nobody knows yet how many there are; a heap has some seven a body.
  const std::uint32_t blocks =
      std::clamp(view.body_count / (kDigestThreads / 8), 1U, kDigestBlocksPerMultiprocessor * multiprocessors);
  digest_kernel<<<blocks, kDigestThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the digest");
}

}  // namespace broadside::gpu
