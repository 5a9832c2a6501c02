// The kernel of a frame of turning bodies that finds their patches of contact, where no shape is a hull or a mesh.
#include "gpu/rigid/contact_launch.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/contact_frame.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Two: 128 registers a thread.
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    contact_kernel(const __grid_constant__ ContactView frame) {
  run_short_contacts(frame);
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

core::Status launch_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(contact_kernel, frame, shape, stream);
}

}  // namespace broadside::gpu
