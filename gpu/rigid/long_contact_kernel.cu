// The kernels of a frame of turning bodies in which all shapes meet: contacts where shapes are hulls or meshes,
// contacts with sweep=fast, and those that stop fast bodies short. In one unit, since the shapes are slow to compile.
#include <algorithm>

#include "gpu/rigid/contact_launch.hpp"
#include "gpu/rigid/swept_launch.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/contact_frame.cuh"
#include "gpu/stages/rigid/swept_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Two: 128 registers a thread.
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    long_contact_kernel(const __grid_constant__ ContactView frame) {
  run_contacts<true>(frame);
}

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    swept_contact_kernel(const __grid_constant__ ContactView frame) {
  run_contacts<true, true>(frame);
}

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    ways_kernel(const __grid_constant__ SweptView view) {
  run_ways(view);
}

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    stop_short_kernel(const __grid_constant__ SweptView view) {
  run_stop_short(view);
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

core::Result<LaunchShape> swept_contact_launch_shape() {
  auto shape = contact_launch_shape();  // says whether this GPU can
  if (!shape.ok()) return shape.error();
  LaunchShape own{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(swept_contact_kernel), own));
  return own;
}

core::Status launch_swept_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(swept_contact_kernel, frame, shape, stream);
}

core::Result<LaunchShape> swept_launch_shape() {
  LaunchShape shape{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(stop_short_kernel), shape));
  return shape;
}

core::Status launch_ways(const SweptView& view, StreamHandle stream) {
  const std::uint32_t blocks = std::max((view.bodies.body_count + kThreads - 1) / kThreads, 1U);
  ways_kernel<<<blocks, kThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the ways of bodies");
}

core::Status launch_stop_short(const SweptView& view, const LaunchShape& shape, StreamHandle stream) {
  return launch(stop_short_kernel, view, shape, stream);
}

}  // namespace broadside::gpu
