#include "reference/scene_octree/curve_order.hpp"

#include "reference/scene_octree/curve_keys.hpp"

namespace broadside::reference {
namespace {

// More boxes than this in one cell are ordered again in a grid over their own centers. Fewer make two packs, which
// overlap in any order.
constexpr std::size_t kLongRun = 16;

}  // namespace

std::span<const KeyedId> CurveOrder::order(const BoxRecord* records, std::uint32_t count) {
  entries_.resize(count);
  scratch_.resize(count);
  for (std::uint32_t k = 0; k < count; ++k) entries_[k] = keyed_id(0, k);
  order_part(records, 0, count);
  return entries_;
}

// Centers at opposite ends of a grid fall into different cells, so every round splits; it ends when centers coincide.
void CurveOrder::order_part(const BoxRecord* records, std::size_t begin, std::size_t end) {
  if (end - begin <= core::kTreeWidth) return;
  core::Box half_centers = core::empty_box();
  for (std::size_t k = begin; k < end; ++k)
    half_centers = core::grown(half_centers, core::half_center(records[id_of(entries_[k])].box));
  const auto count = static_cast<std::uint32_t>(end - begin);
  const core::CurveGrid grid = core::make_curve_grid(half_centers, core::curve_bits(count, core::kCurveBits));
  if (grid.cells_per_m == 0.0F) return;
  for_each_code(
      grid, begin, end, [&](std::size_t k) -> const core::Box& { return records[id_of(entries_[k])].box; },
      [&](std::size_t k, std::uint32_t code) { entries_[k] = keyed_id(code, id_of(entries_[k])); });
  sort_by_key(std::span(entries_).subspan(begin, count), scratch_, 3 * grid.bits);
  for (std::size_t at = begin; at + kLongRun < end;) {
    const std::uint32_t key = key_of(entries_[at]);
    if (key_of(entries_[at + kLongRun]) != key) {
      ++at;
      continue;
    }
    std::size_t past = at + kLongRun + 1U;
    while (past < end && key_of(entries_[past]) == key) ++past;
    order_part(records, at, past);
    at = past;
  }
}

}  // namespace broadside::reference
