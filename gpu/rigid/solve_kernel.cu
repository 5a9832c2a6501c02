// The kernel of a frame of turning bodies that solves their contacts.
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

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    solve_kernel(const __grid_constant__ RigidFrameView frame) {
  __shared__ SolveShared shared;
  run_solve(frame, shared);
}

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
  auto can_cluster = attribute(cudaDevAttrClusterLaunch);
  if (!can_cluster.ok()) return can_cluster.error();
  if (can_cluster.value() == 0) return std::uint32_t{1};
  BROADSIDE_CUDA_TRY(cudaFuncSetAttribute(reinterpret_cast<const void*>(solve_kernel),
                                          cudaFuncAttributeNonPortableClusterSizeAllowed, 1));
  for (std::uint32_t blocks = kMostClusterBlocks; blocks > 1; blocks /= 2) {
    cudaLaunchAttribute attribute;
    const cudaLaunchConfig_t config = cluster_config(blocks, attribute);
    int clusters = 0;
    const cudaError_t error =
        cudaOccupancyMaxActiveClusters(&clusters, reinterpret_cast<const void*>(solve_kernel), &config);
    if (error == cudaSuccess && clusters > 0) return blocks;
    (void)cudaGetLastError();  // too large a cluster is no error of the program's
  }
  return std::uint32_t{1};
}

}  // namespace

core::Result<SolveShape> solve_launch_shape() {
  SolveShape shape;
  shape.grid.threads = kThreads;
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(solve_kernel), shape.grid));
  auto most = most_cluster_blocks();
  if (!most.ok()) return most.error();
  shape.cluster_blocks = most.value();
  return shape;
}

core::Status launch_solve(const RigidFrameView& frame, std::uint32_t blocks, StreamHandle stream) {
  if (frame.solve_team == SolveTeamKind::kGrid) return launch(solve_kernel, frame, {kThreads, blocks, 0, 0}, stream);
  cudaLaunchAttribute attribute;
  cudaLaunchConfig_t config = cluster_config(blocks, attribute);
  config.stream = stream;
  void* arguments[] = {const_cast<RigidFrameView*>(&frame)};
  return cuda_status(cudaLaunchKernelExC(&config, reinterpret_cast<const void*>(solve_kernel), arguments),
                     "launching the solver");
}

}  // namespace broadside::gpu
