// Shares of bulk pairs on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/named_pairs.cuh"

namespace broadside::gpu {

core::Result<PairsShape> named_pairs_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits) {
  auto made = pairs_launch_shape(Start::kBulk, boxes, buckets, limits);
  if (!made.ok()) return made.error();
  PairsShape shape = made.value();
  shape.search.shared_bytes = shape.search.threads / 32 * static_cast<std::uint32_t>(sizeof(BulkNotes));
  return shape;
}

core::Status launch_named_pairs(const NamedPairsView& view, const PairsShape& shape, StreamHandle stream) {
  if (shape.bins.bins != 0 && !view.is_in_order) BROADSIDE_TRY(launch_sort(view.search, shape, stream));
  on_host::run({{shape.search.blocks}, {shape.search.threads}, 0}, shape.search.shared_bytes,
               [&](unsigned char* shared) { run_named_pairs(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
