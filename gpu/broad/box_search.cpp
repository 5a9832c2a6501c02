#include "gpu/broad/box_search.hpp"

#include <algorithm>
#include <utility>

#include "gpu/broad/shared_boxes.hpp"

namespace broadside::gpu {
namespace {

// The densest scenes of the campaign have some eight overlaps a box; a search that finds more is repeated.
constexpr std::uint64_t kPairsPerBox = 8;

// A pass finds in its own coordinates up to some twenty times the pairs that it keeps. Where pairs are handed on in
// chunks, the found ones have room of their own, this many a box. So a chunk can be as large as asked for, and one box
// alone never finds more than there is room for.
constexpr std::uint64_t kFoundPerBox = 2;

// Sets that are searched in shares are so large that one lane a box is enough.
std::uint32_t lanes_for(const BoxFacts& facts, const PairFinderOptions& options) {
  return options.has_shares ? 1 : facts.fit.lanes_per_box;
}

// Makes room for this many boxes. The first `kept` boxes stay.
core::Status make_room(DeviceBuffer<PackedBox>& room, std::size_t boxes, std::size_t kept, StreamHandle stream) {
  if (boxes <= room.capacity()) return core::Done{};
  DeviceBuffer<PackedBox> larger;
  BROADSIDE_TRY(larger.reserve(boxes, "boxes"));
  if (kept != 0) BROADSIDE_TRY(copy_on_device(larger.data(), room.data(), kept * sizeof(PackedBox), stream));
  BROADSIDE_TRY(wait_for_stream(stream, "moving boxes"));
  room = std::move(larger);
  return core::Done{};
}

}  // namespace

std::uint64_t BoxSearch::first_room(const PairFinderOptions& options) const {
  const std::uint64_t expected = std::max(kLeastPairs, kPairsPerBox * count_);
  return options.pairs_at_once == 0 ? expected : std::min(options.pairs_at_once, expected);
}

core::Status BoxSearch::reserve(const BoxFacts& facts, const PairFinderOptions& options) {
  start_ = options.start(facts);
  count_ = facts.count;
  BROADSIDE_TRY(outcome_.allocate());
  BROADSIDE_TRY(boxes_.reserve(count_, "boxes"));
  BROADSIDE_TRY(counters_.reserve(1, "counters"));
  BROADSIDE_TRY(barrier_.reserve(1, "barrier"));
  BROADSIDE_TRY(barrier_.fill_bytes(0));
  BROADSIDE_TRY(pairs_.reserve(first_room(options), "pairs"));
  const auto buckets = static_cast<std::uint32_t>(bulk_buckets(facts));
  const BinLimits limits{options.least_for_bins, options.most_bins_at_once};
  lanes_per_box_ = lanes_for(facts, options);
  auto shape = options.has_shares && can_share() ? named_pairs_launch_shape(count_, buckets, limits)
               : can_share()                     ? bulk_launch_shape(count_, buckets, limits, lanes_per_box_)
                                                 : pairs_launch_shape(start_, count_, buckets, limits);
  if (!shape.ok()) return shape.error();
  shape_ = shape.value();
  BROADSIDE_TRY(broad_.load(start_, facts, options.hash_cell_m, options.variant, shape_.bins, shape_.sort.blocks));
  is_grouped_ = wants_groups(facts);
  if (is_grouped_) {
    auto grouped = grouped_pairs_launch_shape();
    if (!grouped.ok()) return grouped.error();
    grouped_shape_ = grouped.value();
    BROADSIDE_TRY(groups_.load(facts));
  }
  view_ = {};
  view_.box_count = count_;
  view_.boxes = boxes_.data();
  view_.counters = counters_.data();
  view_.barrier = barrier_.data();
  view_.outcome = outcome_.device(0);
  return wait_for_device("clearing the broad phase");
}

core::Result<PackedBox*> BoxSearch::room_for(std::size_t boxes) {
  BROADSIDE_TRY(boxes_.reserve(boxes, "boxes"));
  return boxes_.data();
}

core::Result<PackedBox*> BoxSearch::move_to_room_for(std::size_t boxes, std::size_t kept, StreamHandle stream) {
  BROADSIDE_TRY(make_room(boxes_, boxes, kept, stream));
  view_.boxes = boxes_.data();
  return boxes_.data();
}

core::Result<PackedBox*> BoxSearch::room_for_given(std::size_t boxes, std::size_t kept, StreamHandle stream) {
  BROADSIDE_TRY(make_room(given_, boxes, kept, stream));
  return given_.data();
}

core::Status BoxSearch::settle_on_given(std::uint32_t owned, const PairFinderOptions& options) {
  auto shape = settle_launch_shape();
  if (!shape.ok()) return shape.error();
  settle_shape_ = shape.value();
  BROADSIDE_TRY(settled_.reserve(first_room(options), "pairs"));
  BROADSIDE_TRY(pairs_.reserve(std::max(first_room(options), kFoundPerBox * count_), "pairs of a pass"));
  settle_.given = given_.data();
  settle_.owned = owned;
  settle_.counters = view_.counters;
  settle_.barrier = view_.barrier;
  settle_.outcome = view_.outcome;
  return core::Done{};
}

core::Status BoxSearch::load_packed(const BoxFacts& facts, const PairFinderOptions& options, bool is_new) {
  if (is_new) has_too_many_group_pairs_ = false;
  const bool is_as_before = facts.count == count_ && options.start(facts) == start_ &&
                            lanes_for(facts, options) == lanes_per_box_ && wants_groups(facts) == is_grouped_;
  if (is_new || !is_as_before) BROADSIDE_TRY(reserve(facts, options));
  broad_.refit(facts);
  if (is_grouped_) groups_.refit(facts);
  settle_ = {};
  return core::Done{};
}

core::Status BoxSearch::load(const SearchedBoxes& boxes, const PairFinderOptions& options, bool is_new) {
  BROADSIDE_TRY(load_packed(boxes.facts(), options, is_new));
  if (!boxes.given().empty()) {
    BROADSIDE_TRY(given_.upload(boxes.given(), "boxes as given"));
    BROADSIDE_TRY(settle_on_given(boxes.owned(), options));
  }
  return boxes_.upload(boxes.searched(), "boxes");
}

void BoxSearch::fill_view() {
  broad_.fill(view_.broad);
  broad_.fill(view_.bulk);
  view_.pairs = {pairs_.data(), pairs_.capacity()};
}

core::Status BoxSearch::launch_share(const NamedPairsView& share, StreamHandle stream) {
  fill_view();
  NamedPairsView own = share;
  own.search = view_;
  BROADSIDE_TRY(launch_named_pairs(own, shape_, stream));
  return settle(stream);
}

core::Status BoxSearch::settle(StreamHandle stream) {
  if (!is_settled()) return core::Done{};
  settle_.found = view_.pairs;
  settle_.pairs = {settled_.data(), settled_.capacity()};
  return launch_settle(settle_, settle_shape_, stream);
}

core::Status BoxSearch::launch(StreamHandle stream) {
  fill_view();
  BROADSIDE_TRY(launch_search(stream));
  return settle(stream);
}

core::Status BoxSearch::launch_search(StreamHandle stream) {
  if (is_grouped_) return launch_grouped_pairs({view_, groups_.view()}, grouped_shape_, stream);
  return can_share() ? launch_bulk(view_, shape_, lanes_per_box_, stream) : launch_pairs(view_, shape_, stream);
}

core::Status BoxSearch::grow() {
  const Counters& demanded = outcome_[0].counters;
  BROADSIDE_TRY(broad_.grow(demanded));
  if (is_grouped_) {
    auto is_worthwhile = groups_.grow(demanded.group_pairs);
    if (!is_worthwhile.ok()) return is_worthwhile.error();
    has_too_many_group_pairs_ = !is_worthwhile.value();
    is_grouped_ = is_worthwhile.value();
  }
  BROADSIDE_TRY(pairs_.reserve(demanded.pairs, "pairs"));
  if (is_settled()) BROADSIDE_TRY(settled_.reserve(demanded.confirmed, "pairs"));
  return core::Done{};
}

core::Status BoxSearch::count_work(WorkCounter& work, StreamHandle stream) {
  return work.count_broad({view_.broad, view_.bulk, view_.boxes, view_.box_count, view_.counters},
                          shape_.search.multiprocessors, stream);
}

double BoxSearch::fullness() const {
  const Counters& counts = outcome_[0].counters;
  const auto part = [](std::uint64_t pairs, std::uint64_t room) {
    return static_cast<double>(pairs) / static_cast<double>(room);
  };
  const double found = part(counts.pairs, pairs_.capacity());
  return is_settled() ? std::max(found, part(counts.confirmed, settled_.capacity())) : found;
}

FoundPairs BoxSearch::found() const {
  const Counters& counts = outcome_[0].counters;
  return is_settled() ? FoundPairs{settled_.data(), counts.confirmed} : FoundPairs{pairs_.data(), counts.pairs};
}

core::Status BoxSearch::append_pairs(std::vector<core::Pair>& to) const {
  const FoundPairs from = found();
  const std::size_t before = to.size();
  to.resize(before + from.count);
  if (from.count == 0) return core::Done{};
  return copy_to_host(to.data() + before, from.data, from.count * sizeof(core::Pair));
}

}  // namespace broadside::gpu
