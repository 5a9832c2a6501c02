// The search by groups on fibers of the host.
#include "gpu/broad/grouped_view.hpp"
#include "gpu/on_host/small_grid.hpp"
#include "gpu/stages/pairs_only/grouped_pairs.cuh"

namespace broadside::gpu {

core::Result<LaunchShape> grouped_pairs_launch_shape() {
  return LaunchShape{on_host::kThreads, on_host::kBlocks, grouped_shared_bytes(on_host::kThreads), on_host::kBlocks};
}

core::Status launch_grouped_pairs(const GroupedPairsView& view, const LaunchShape& shape, StreamHandle /*stream*/) {
  on_host::run({{shape.blocks}, {shape.threads}, on_host::order_seed()}, shape.shared_bytes,
               [&](unsigned char* shared) { run_grouped_pairs(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
