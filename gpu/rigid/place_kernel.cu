// The kernels of a frame of turning bodies that need no barrier: boxes at its beginning, and its digest.
#include <algorithm>

#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/stages/rigid/place_stage.cuh"
#include "gpu/stages/rigid/rigid_digest.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kPlaceThreads = 256;

__global__ void __launch_bounds__(kPlaceThreads) place_kernel(const __grid_constant__ RigidFrameView frame) {
  run_place(frame);
}

__global__ void __launch_bounds__(kPlaceThreads) rigid_digest_kernel(const __grid_constant__ RigidDigestView view) {
  run_rigid_digest(view);
}

std::uint32_t blocks_for(std::uint64_t items, const LaunchShape& shape) {
  return static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>((items + kPlaceThreads - 1) / kPlaceThreads, 1, 4 * shape.blocks));
}

}  // namespace

core::Status launch_place(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  place_kernel<<<blocks_for(frame.body_count, shape), kPlaceThreads, 0, stream>>>(frame);
  return cuda_status(cudaGetLastError(), "launching boxes");
}

core::Status launch_rigid_digest(const RigidDigestView& view, const LaunchShape& shape, StreamHandle stream) {
  const std::uint64_t items = std::max<std::uint64_t>({view.body_count, view.confirmed_count, view.patch_count});
  rigid_digest_kernel<<<blocks_for(items, shape), kPlaceThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the digest");
}

}  // namespace broadside::gpu
