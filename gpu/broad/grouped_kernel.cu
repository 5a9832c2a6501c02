#include "gpu/broad/grouped_view.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/grouped_pairs.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kGroupedThreads = 512;
constexpr std::uint32_t kGroupedBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kGroupedThreads, kGroupedBlocksPerMultiprocessor)
    grouped_pairs_kernel(const __grid_constant__ GroupedPairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_grouped_pairs(view, shared);
}

}  // namespace

core::Result<LaunchShape> grouped_pairs_launch_shape() {
  LaunchShape shape{kGroupedThreads, 0, grouped_shared_bytes(kGroupedThreads), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(grouped_pairs_kernel), shape));
  return shape;
}

core::Status launch_grouped_pairs(const GroupedPairsView& view, const LaunchShape& shape, StreamHandle stream) {
  return launch(grouped_pairs_kernel, view, shape, stream);
}

}  // namespace broadside::gpu
