#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/pairs_only/cross_search.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kCrossThreads = 512;

__global__ void __launch_bounds__(kCrossThreads, 2) cross_kernel(const __grid_constant__ CrossView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_cross(view, shared);
}

__global__ void __launch_bounds__(kPlainThreads) mark_kernel(const __grid_constant__ MarkView view) {
  run_mark(view);
}

}  // namespace

core::Status launch_mark(const MarkView& view, StreamHandle stream) {
  return launch_over(view.count, mark_kernel, view, stream);
}

core::Result<LaunchShape> cross_launch_shape() {
  LaunchShape shape{kCrossThreads, 0, kCrossThreads / 32 * static_cast<std::uint32_t>(sizeof(PairQueue)), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(cross_kernel), shape));
  return shape;
}

core::Status launch_cross(const CrossView& view, const LaunchShape& shape, StreamHandle stream) {
  return launch(cross_kernel, view, shape, stream);
}

}  // namespace broadside::gpu
