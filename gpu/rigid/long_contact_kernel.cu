// The kernel of a frame of turning bodies that finds their patches of contact, where shapes are hulls or meshes: slow
// to compile, for all shapes meet here.
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
    long_contact_kernel(const __grid_constant__ ContactView frame) {
  run_contacts<true>(frame);
}

}  // namespace

core::Result<LaunchShape> long_contact_launch_shape() {
  auto shape = contact_launch_shape();  // says whether this GPU can
  if (!shape.ok()) return shape.error();
  LaunchShape own{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(long_contact_kernel), own));
  return own;
}

core::Status launch_long_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(long_contact_kernel, frame, shape, stream);
}

}  // namespace broadside::gpu
