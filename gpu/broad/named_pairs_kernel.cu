#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/named_pairs.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kNamedThreads = 512;

__global__ void __launch_bounds__(kNamedThreads, 2) named_pairs_kernel(const __grid_constant__ NamedPairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_named_pairs(view, shared);
}

}  // namespace

core::Result<PairsShape> named_pairs_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits) {
  auto made = pairs_launch_shape(Start::kBulk, boxes, buckets, limits);
  if (!made.ok()) return made.error();
  PairsShape shape = made.value();
  shape.search = {kNamedThreads, 0, kNamedThreads / 32 * static_cast<std::uint32_t>(sizeof(BulkNotes)), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(named_pairs_kernel), shape.search));
  return shape;
}

core::Status launch_named_pairs(const NamedPairsView& view, const PairsShape& shape, StreamHandle stream) {
  if (shape.bins.bins != 0 && !view.is_in_order) BROADSIDE_TRY(launch_sort(view.search, shape, stream));
  return launch(named_pairs_kernel, view, shape.search, stream);
}

}  // namespace broadside::gpu
