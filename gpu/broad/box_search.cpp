#include "gpu/broad/box_search.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace broadside::gpu {
namespace {

using core::Box;

// Some eight overlaps a box in the densest scenes of the campaign; a frame that finds more is found again.
constexpr std::uint64_t kPairsPerBox = 8;

bool is_sound(const Box& box) {
  for (int k = 0; k < 3; ++k)
    if (!(std::isfinite(box.min[k]) && std::isfinite(box.max[k]) && box.min[k] <= box.max[k])) return false;
  return true;
}

}  // namespace

void SearchedBoxes::start() {
  searched_.clear();
  given_.clear();
  facts_ = {};
  bounds_ = core::empty_box();
  owned_ = 0;
}

// Packs, and learns what the cells' sizes depend on.
void SearchedBoxes::add(const Box& box, bool is_static) {
  for (int k = 0; k < 3; ++k) {
    facts_.largest_side_m = std::max(facts_.largest_side_m, box.max[k] - box.min[k]);
    facts_.coordinate_range_m = std::max({facts_.coordinate_range_m, std::abs(box.min[k]), std::abs(box.max[k])});
  }
  bounds_ = core::grown(core::grown(bounds_, box.min), box.max);
  searched_.push_back(pack(box, facts_.count++, is_static ? 1U : 0U));
}

void SearchedBoxes::finish() {
  if (facts_.count == 0) return;
  facts_.low_corner = bounds_.min;
  facts_.domain = bounds_;
}

core::Status SearchedBoxes::take(std::span<const Box> boxes, std::span<const std::uint8_t> is_static,
                                 const PairFinderOptions& options) {
  start();
  searched_.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_sound(boxes[i]))
      return core::Error{"a box has min > max, or is NaN or infinite", "box " + std::to_string(i),
                         "give finite boxes with min <= max"};
    add(boxes[i], is_static[i] != 0);
    if (options.broad == Broad::kHash)
      facts_.hash_entries += hash_cells_of(boxes[i].max - boxes[i].min, options.hash_cell_m);
  }
  finish();
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
  finish();
}

core::Status BoxSearch::reserve(const SearchedBoxes& boxes, const PairFinderOptions& options) {
  const BoxFacts& facts = boxes.facts();
  start_ = options.start(facts);
  count_ = facts.count;
  BROADSIDE_TRY(outcome_.allocate());
  BROADSIDE_TRY(boxes_.reserve(count_, "boxes"));
  BROADSIDE_TRY(counters_.reserve(1, "counters"));
  BROADSIDE_TRY(barrier_.reserve(1, "barrier"));
  BROADSIDE_TRY(barrier_.fill_bytes(0));
  BROADSIDE_TRY(pairs_.reserve(std::max(kLeastPairs, kPairsPerBox * count_), "pairs"));
  auto shape =
      pairs_launch_shape(start_, count_, static_cast<std::uint32_t>(grid_buckets(count_)), options.least_for_bins);
  if (!shape.ok()) return shape.error();
  shape_ = shape.value();
  BROADSIDE_TRY(broad_.load(start_, facts, options.hash_cell_m, options.variant, shape_.bins, shape_.sort.blocks));
  view_ = {};
  view_.box_count = count_;
  view_.boxes = boxes_.data();
  view_.counters = counters_.data();
  view_.barrier = barrier_.data();
  view_.outcome = outcome_.device(0);
  return wait_for_device("clearing the broad phase");
}

core::Status BoxSearch::load(const SearchedBoxes& boxes, const PairFinderOptions& options, bool is_new) {
  if (is_new || boxes.facts().count != count_ || options.start(boxes.facts()) != start_)
    BROADSIDE_TRY(reserve(boxes, options));
  broad_.refit(boxes.facts());
  view_.settle = {};
  if (!boxes.given().empty()) {
    BROADSIDE_TRY(given_.upload(boxes.given(), "boxes as given"));
    BROADSIDE_TRY(settled_.reserve(std::max(kLeastPairs, kPairsPerBox * count_), "pairs"));
    view_.settle.given = given_.data();
    view_.settle.owned = boxes.owned();
  }
  return boxes_.upload(boxes.searched(), "boxes");
}

core::Status BoxSearch::launch(StreamHandle stream) {
  broad_.fill(view_.broad);
  broad_.fill(view_.bulk);
  view_.pairs = {pairs_.data(), pairs_.capacity()};
  view_.settle.pairs = {settled_.data(), settled_.capacity()};
  return launch_pairs(view_, shape_, stream);
}

core::Status BoxSearch::grow() {
  const Counters& demanded = outcome_[0].counters;
  BROADSIDE_TRY(broad_.grow(demanded));
  BROADSIDE_TRY(pairs_.reserve(demanded.pairs, "pairs"));
  if (view_.settle.given != nullptr) BROADSIDE_TRY(settled_.reserve(demanded.confirmed, "pairs"));
  return core::Done{};
}

core::Status BoxSearch::count_work(WorkCounter& work, StreamHandle stream) {
  return work.count_broad({view_.broad, view_.bulk, view_.boxes, view_.box_count, view_.counters},
                          shape_.search.multiprocessors, stream);
}

core::Status BoxSearch::append_pairs(std::vector<core::Pair>& to) const {
  const Counters& counts = outcome_[0].counters;
  const bool is_settled = view_.settle.given != nullptr;
  std::vector<core::Pair> found;
  BROADSIDE_TRY((is_settled ? settled_ : pairs_).download(found, is_settled ? counts.confirmed : counts.pairs));
  if (to.empty())
    to = std::move(found);
  else
    to.insert(to.end(), found.begin(), found.end());
  return core::Done{};
}

}  // namespace broadside::gpu
