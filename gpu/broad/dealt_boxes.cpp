#include "gpu/broad/dealt_boxes.hpp"

#include <algorithm>
#include <string>

#include "gpu/broad/fitted_cells.hpp"
#include "gpu/broad/searched_boxes.hpp"

namespace broadside::gpu {

core::Status check_box_limit(std::uint64_t boxes) {
  if (boxes <= kMostBoxes) return core::Done{};
  return core::Error{
      std::to_string(boxes) + " boxes are more than the " + std::to_string(kMostBoxes) + " that one search can number",
      "broad phase on the GPU", "search the set in parts: pairs --parts P", core::Exit::kMissing};
}

namespace {

// One box of the set, in the coordinates that are searched.
struct Dealt {
  core::Box box;
  std::uint32_t id = 0;  // the caller's number
  bool is_static = false;
};

}  // namespace

// Within a part, boxes stay in the order in which they were given.
template <typename BoxAt>
void DealtBoxes::deal(std::size_t boxes, const core::SpaceCut& cut, const BoxAt& box_at) {
  std::vector<FactsOfBoxes> of_part(cut.parts());
  std::vector<std::uint32_t> count(cut.parts());
  for (std::size_t k = 0; k < boxes; ++k) {
    const core::Box box = box_at(k).box;
    const std::uint32_t part = cut.part_at(box.min[cut.axis]);
    ++count[part];
    of_part[part].add(box);
  }
  base_.assign(cut.parts() + 1, 0);
  for (std::uint32_t part = 0; part < cut.parts(); ++part) base_[part + 1] = base_[part] + count[part];
  packed_.resize(boxes);
  given_.resize(boxes);
  std::vector<std::uint32_t> next(base_.begin(), base_.end() - 1);
  for (std::size_t k = 0; k < boxes; ++k) {
    const Dealt dealt = box_at(k);
    const std::uint32_t number = next[cut.part_at(dealt.box.min[cut.axis])]++;
    packed_[number] = pack(dealt.box, dealt.id, dealt.is_static ? 1U : 0U);
    given_[number] = dealt.id;
  }
  facts_.clear();
  BoxFacts all;
  core::Box bounds = core::empty_box();
  for (const FactsOfBoxes& part : of_part) {
    facts_.push_back(part.all());
    if (facts_.back().count == 0) continue;
    all.largest_side_m = std::max(all.largest_side_m, facts_.back().largest_side_m);
    all.coordinate_range_m = std::max(all.coordinate_range_m, facts_.back().coordinate_range_m);
    bounds = core::grown(core::grown(bounds, facts_.back().domain.min), facts_.back().domain.max);
  }
  for (std::uint32_t part = 0; part < cut.parts(); ++part) {
    BoxFacts& facts = facts_[part];
    facts.largest_side_m = all.largest_side_m;
    facts.coordinate_range_m = all.coordinate_range_m;
    facts.low_corner = bounds.min;
    // A box that reaches over a face begins at most its own length before the face.
    if (part > 0) facts.low_corner[cut.axis] = std::max(bounds.min[cut.axis], cut.faces[part - 1] - all.largest_side_m);
  }
}

core::Status DealtBoxes::take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                              const core::SpaceCut& cut) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (!is_sound(boxes[i])) return bad_box(i);
  given_boxes_.clear();
  deal(boxes.size(), cut, [&](std::size_t i) {
    return Dealt{boxes[i], static_cast<std::uint32_t>(i), is_static[i] != 0};
  });
  return core::Done{};
}

void DealtBoxes::take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                      const core::SpaceCut& cut, const core::PassPlan& plan, const core::BoxPass& pass) {
  std::vector<std::uint32_t> members;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (pass.has(plan.group(boxes[i]))) members.push_back(static_cast<std::uint32_t>(i));
  deal(members.size(), cut, [&](std::size_t k) {
    return Dealt{pass.map(boxes[members[k]]), members[k], is_static[members[k]] != 0};
  });
  given_boxes_.clear();
  for (const std::uint32_t id : given_)
    given_boxes_.push_back(pack(boxes[id], id, plan.group(boxes[id]) << 1U | (is_static[id] != 0 ? 1U : 0U)));
}

BulkFit DealtBoxes::fitted(std::span<const core::Box> boxes) const {
  BoxFacts all;
  for (const BoxFacts& facts : facts_) all.largest_side_m = std::max(all.largest_side_m, facts.largest_side_m);
  all.count = static_cast<std::uint32_t>(std::min<std::uint64_t>(boxes.size(), 0xFFFFFFFFU));
  BulkFit fit;
  fit.cell_scale = bulk_fit(boxes, all).cell_scale;
  return fit;
}

}  // namespace broadside::gpu
