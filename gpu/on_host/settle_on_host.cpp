// Settling pairs on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/settle_stage.cuh"

namespace broadside::gpu {

core::Result<LaunchShape> settle_launch_shape() {
  return LaunchShape{64, 2, 2 * static_cast<std::uint32_t>(sizeof(PairQueue)), 2};
}

core::Status launch_settle(const SettleView& view, const LaunchShape& shape, StreamHandle /*stream*/) {
  on_host::run({{shape.blocks}, {shape.threads}, 0}, shape.shared_bytes,
               [&](unsigned char* shared) { run_settle(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
