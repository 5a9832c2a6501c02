// The first of two kernels that find contacts where shapes are hulls or meshes or where bodies are swept: it lists the
// pairs that are near, and makes the patches of most pairs of finely cut hulls. Its code is small enough to stay in the
// instruction caches; the code of all shapes is not.
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
    near_contact_kernel(const __grid_constant__ ContactView frame) {
  run_near_contacts(frame);
}

}  // namespace

core::Result<LaunchShape> near_contact_launch_shape() {
  auto shape = contact_launch_shape();  // an error if this GPU cannot launch it
  if (!shape.ok()) return shape.error();
  LaunchShape own{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(near_contact_kernel), own));
  return own;
}

core::Status launch_near_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(near_contact_kernel, frame, shape, stream);
}

}  // namespace broadside::gpu
