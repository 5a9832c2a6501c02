// The search by groups on fibers of the host: two blocks of two warps.
#include "gpu/broad/grouped_view.hpp"
#include "gpu/stages/pairs_only/grouped_pairs.cuh"

namespace broadside::gpu {

core::Result<LaunchShape> grouped_pairs_launch_shape() {
  constexpr std::uint32_t kGroupedThreads = 64;
  return LaunchShape{kGroupedThreads, 2, grouped_shared_bytes(kGroupedThreads), 2};
}

core::Status launch_grouped_pairs(const GroupedPairsView& view, const LaunchShape& shape, StreamHandle /*stream*/) {
  on_host::run({{shape.blocks}, {shape.threads}, 0}, shape.shared_bytes,
               [&](unsigned char* shared) { run_grouped_pairs(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
