// Kernels of a frame of turning bodies whose threads have one body, or one pair of bodies.
#include <algorithm>

#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/contact_frame.cuh"
#include "gpu/stages/rigid/place_stage.cuh"
#include "gpu/stages/rigid/rigid_digest.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Two: 128 registers a thread.
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kThreads) place_kernel(const __grid_constant__ RigidFrameView frame) {
  run_place(frame);
}

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    contact_kernel(const __grid_constant__ RigidFrameView frame) {
  run_contacts(frame);
}

__global__ void __launch_bounds__(kThreads) rigid_digest_kernel(const __grid_constant__ RigidDigestView view) {
  run_rigid_digest(view);
}

std::uint32_t blocks_for(std::uint64_t items, const LaunchShape& shape) {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>((items + kThreads - 1) / kThreads, 1, 4 * shape.blocks));
}

}  // namespace

core::Result<LaunchShape> contact_launch_shape() {
  auto is_cooperative = attribute(cudaDevAttrCooperativeLaunch);
  if (!is_cooperative.ok()) return is_cooperative.error();
  LaunchShape shape{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(contact_kernel), shape));
  if (is_cooperative.value() == 0 || shape.blocks == 0)
    return core::Error{"this GPU cannot launch the kernel of turning bodies", "octree-gpu",
                       "use one of compute capability 7.5 or later", core::Exit::kMissing};
  return shape;
}

core::Status launch_place(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  place_kernel<<<blocks_for(frame.body_count, shape), kThreads, 0, stream>>>(frame);
  return cuda_status(cudaGetLastError(), "launching boxes");
}

core::Status launch_contacts(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(contact_kernel, frame, shape, stream);
}

core::Status launch_rigid_digest(const RigidDigestView& view, const LaunchShape& shape, StreamHandle stream) {
  const std::uint64_t items = std::max<std::uint64_t>({view.body_count, view.confirmed_count, view.patch_count});
  rigid_digest_kernel<<<blocks_for(items, shape), kThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the digest");
}

}  // namespace broadside::gpu
