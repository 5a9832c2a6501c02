#include "gpu/broad/searched_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "gpu/broad/fitted_cells.hpp"

namespace broadside::gpu {

using core::Box;

bool is_sound(const Box& box) {
  for (int k = 0; k < 3; ++k)
    if (!(std::isfinite(box.min[k]) && std::isfinite(box.max[k]) && box.min[k] <= box.max[k])) return false;
  return true;
}

core::Error bad_box(std::size_t place) {
  return {"a box has min > max, or is NaN or infinite", "box " + std::to_string(place),
          "give finite boxes with min <= max"};
}

core::Error another_count(std::size_t given, std::size_t loaded) {
  return {"update was given " + std::to_string(given) + " boxes after a load of " + std::to_string(loaded),
          "broad phase on the GPU", "load again when the number of boxes changes"};
}

void FactsOfBoxes::add(const Box& box) {
  for (int k = 0; k < 3; ++k) {
    facts_.largest_side_m = std::max(facts_.largest_side_m, box.max[k] - box.min[k]);
    facts_.coordinate_range_m = std::max({facts_.coordinate_range_m, std::abs(box.min[k]), std::abs(box.max[k])});
  }
  bounds_ = core::grown(core::grown(bounds_, box.min), box.max);
  ++facts_.count;
}

BoxFacts FactsOfBoxes::all() const {
  BoxFacts facts = facts_;
  if (facts.count == 0) return facts;
  facts.low_corner = bounds_.min;
  facts.domain = bounds_;
  return facts;
}

void SearchedBoxes::start() {
  searched_.clear();
  given_.clear();
  facts_of_all_ = {};
  owned_ = 0;
}

void SearchedBoxes::add(const Box& box, bool is_static) {
  facts_of_all_.add(box);
  searched_.push_back(pack(box, static_cast<std::uint32_t>(searched_.size()), is_static ? 1U : 0U));
}

core::Status SearchedBoxes::take(std::span<const Box> boxes, std::span<const std::uint8_t> is_static,
                                 const PairFinderOptions& options) {
  start();
  searched_.reserve(boxes.size());
  std::uint64_t hash_entries = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_sound(boxes[i])) return bad_box(i);
    add(boxes[i], is_static[i] != 0);
    if (options.broad == Broad::kHash) hash_entries += hash_cells_of(boxes[i].max - boxes[i].min, options.hash_cell_m);
  }
  facts_ = facts_of_all_.all();
  facts_.hash_entries = hash_entries;
  return core::Done{};
}

void SearchedBoxes::take(std::span<const Box> boxes, std::span<const std::uint8_t> is_static,
                         const core::PassPlan& plan, const core::BoxPass& pass) {
  start();
  owned_ = pass.owned;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::uint32_t group = plan.group(boxes[i]);
    if (!pass.has(group)) continue;
    add(pass.map(boxes[i]), is_static[i] != 0);
    given_.push_back(pack(boxes[i], static_cast<std::uint32_t>(i), group << 1U | (is_static[i] != 0 ? 1U : 0U)));
  }
  facts_ = facts_of_all_.all();
}

std::vector<core::Box> SearchedBoxes::sample() const {
  std::vector<core::Box> some;
  for (const std::uint32_t k : boxes_to_fit_by(searched_.size())) some.push_back(unpack(searched_[k]));
  return some;
}

}  // namespace broadside::gpu
