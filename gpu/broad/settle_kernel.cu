#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/settle_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kSettlingThreads = 512;

__global__ void __launch_bounds__(kSettlingThreads, 2) settle_kernel(const __grid_constant__ SettleView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_settle(view, shared);
}

}  // namespace

core::Result<LaunchShape> settle_launch_shape() {
  LaunchShape shape{kSettlingThreads, 0, kSettlingThreads / 32 * static_cast<std::uint32_t>(sizeof(PairQueue)), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(settle_kernel), shape));
  return shape;
}

core::Status launch_settle(const SettleView& view, const LaunchShape& shape, StreamHandle stream) {
  return launch(settle_kernel, view, shape, stream);
}

}  // namespace broadside::gpu
