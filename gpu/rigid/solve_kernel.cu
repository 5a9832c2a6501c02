// The kernels of a frame of turning bodies that solve their contacts.
#include <algorithm>

#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/solve_frame.cuh"

namespace broadside::gpu {
namespace {

// A block has one warp for each of a multiprocessor's four schedulers, and two blocks are resident: that leaves 255
// registers a thread, enough for a patch and both its bodies.
constexpr std::uint32_t kThreads = 32 * SolveShared::kMostWarps;
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;
// Not every GPU has clusters of more than 8 blocks.
constexpr std::uint32_t kMostClusterBlocks = 16;

// One kernel for each layout of constraints: a layout that is only known at run time makes a step of 1,000 cubes 3 %
// longer (gpu/EXPERIMENTS.md). Constraints that a cluster solves have single words.
template <bool kHasPairs>
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    solve_kernel(const __grid_constant__ RigidFrameView frame) {
  __shared__ SolveShared shared;
  run_solve(frame, {frame.constraints.words, kHasPairs}, shared);
}
constexpr auto* kSingleWords = &solve_kernel<false>;
constexpr auto* kPairs = &solve_kernel<true>;

cudaLaunchConfig_t cluster_config(std::uint32_t blocks, cudaLaunchAttribute& attribute) {
  attribute = {};
  attribute.id = cudaLaunchAttributeClusterDimension;
  attribute.val.clusterDim = {blocks, 1, 1};
  cudaLaunchConfig_t config = {};
  config.gridDim = dim3(blocks);
  config.blockDim = dim3(kThreads);
  config.attrs = &attribute;
  config.numAttrs = 1;
  return config;
}

// The largest cluster that this GPU can launch; 1 = none.
core::Result<std::uint32_t> most_cluster_blocks() {
  const auto* const kernel = reinterpret_cast<const void*>(kSingleWords);
  auto can_cluster = attribute(cudaDevAttrClusterLaunch);
  if (!can_cluster.ok()) return can_cluster.error();
  if (can_cluster.value() == 0) return std::uint32_t{1};
  BROADSIDE_CUDA_TRY(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1));
  for (std::uint32_t blocks = kMostClusterBlocks; blocks > 1; blocks /= 2) {
    cudaLaunchAttribute attribute;
    const cudaLaunchConfig_t config = cluster_config(blocks, attribute);
    int clusters = 0;
    const cudaError_t error = cudaOccupancyMaxActiveClusters(&clusters, kernel, &config);
    if (error == cudaSuccess && clusters > 0) return blocks;
    (void)cudaGetLastError();  // too large a cluster is no error of the program's
  }
  return std::uint32_t{1};
}

}  // namespace

core::Result<SolveShape> solve_launch_shape() {
  SolveShape shape;
  shape.grid.threads = kThreads;
  LaunchShape of_pairs = shape.grid;
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(kSingleWords), shape.grid));
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(kPairs), of_pairs));
  shape.grid.blocks = std::min(shape.grid.blocks, of_pairs.blocks);
  auto most = most_cluster_blocks();
  if (!most.ok()) return most.error();
  shape.cluster_blocks = most.value();
  return shape;
}

core::Status launch_solve(const RigidFrameView& frame, std::uint32_t blocks, StreamHandle stream) {
  if (frame.solve_team == SolveTeamKind::kGrid)
    return launch(frame.constraints.has_pairs ? kPairs : kSingleWords, frame, {kThreads, blocks, 0, 0}, stream);
  cudaLaunchAttribute attribute;
  cudaLaunchConfig_t config = cluster_config(blocks, attribute);
  config.stream = stream;
  void* arguments[] = {const_cast<RigidFrameView*>(&frame)};
  return cuda_status(cudaLaunchKernelExC(&config, reinterpret_cast<const void*>(kSingleWords), arguments),
                     "launching the solver");
}

}  // namespace broadside::gpu
