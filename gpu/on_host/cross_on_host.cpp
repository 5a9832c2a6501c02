// Runs the search for pairs of moving and standing boxes on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/cross_search.cuh"

namespace broadside::gpu {

core::Status launch_mark(const MarkView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_mark(view); });
  return core::Done{};
}

core::Result<LaunchShape> cross_launch_shape() {
  return LaunchShape{64, 2, 2 * static_cast<std::uint32_t>(sizeof(PairQueue)), 2};
}

core::Status launch_cross(const CrossView& view, const LaunchShape& shape, StreamHandle /*stream*/) {
  on_host::run({{shape.blocks}, {shape.threads}, 0}, shape.shared_bytes,
               [&](unsigned char* shared) { run_cross(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
