#include "gpu/broad/kept_finder.hpp"

#include <algorithm>
#include <string>

#include "gpu/broad/box_search.hpp"
#include "gpu/broad/device_packing.hpp"
#include "gpu/broad/kept_view.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

constexpr std::uint32_t kMostPause = 64;

}  // namespace

struct KeptFinder::Impl {
  explicit Impl(const PairFinderOptions& options) : plain_options(options), fat_options(options), plain(options) {
    fat_options.has_shares = true;
  }

  PairFinderOptions plain_options;
  PairFinderOptions fat_options;
  PairFinder plain;  // searches the boxes as they are
  BoxSearch fat;
  Stream stream;
  DevicePacking packing;
  SearchedBoxes packed;
  std::vector<std::uint8_t> is_static;
  KeptView view;
  DeviceBuffer<PackedBox> now;
  DeviceBuffer<PackedBox> placed;
  DeviceBuffer<std::uint32_t> place_of;
  DeviceBuffer<core::Pair> pairs;
  DeviceBuffer<KeptCounts> counts;    // [0]: zeros; [1]: this frame's
  DeviceBuffer<BoxMeasure> measures;  // [0]: of no box; [1]: of the fat boxes
  Mapped<KeptCounts, 1> counted;
  Mapped<BoxMeasure, 1> measured;
  bool is_fat = false;  // the last search was one of fat boxes
  bool has_candidates = false;
  bool is_kept = false;   // this frame needs no search
  bool is_plain = false;  // the plain finder has been loaded
  bool has_served = true;
  std::uint32_t in_vain = 0;  // how many searches in a row had candidates that served no further frame
  std::uint32_t pause = 0;    // for how many more frames the boxes are searched as they are
  std::uint64_t searched_frames = 0;
  std::uint64_t kept_frames = 0;
  std::uint64_t candidates_tested = 0;
  std::uint64_t pair_count = 0;

  core::Status start(std::span<const std::uint8_t> flags);
  core::Status reserve();
  core::Status clear_counts();
  core::Status read_counts(const char* what);
  core::Status look_within(const float* given);
  core::Status fatten();
  core::Status choose();
  core::Status search_fat();
  core::Status test_candidates();
  // Whether this class reads the frame's boxes; else they go to the plain finder only.
  [[nodiscard]] bool looks() const { return has_candidates || pause == 0; }
};

KeptFinder::KeptFinder(const PairFinderOptions& options) : impl_(std::make_unique<Impl>(options)) {}
KeptFinder::~KeptFinder() = default;

core::Status KeptFinder::Impl::start(std::span<const std::uint8_t> flags) {
  is_static.assign(flags.begin(), flags.end());
  packing.start();
  is_fat = has_candidates = is_kept = is_plain = false;
  has_served = true;
  in_vain = pause = 0;
  searched_frames = kept_frames = candidates_tested = pair_count = 0;
  BROADSIDE_TRY(stream.create());
  return reserve();
}

core::Status KeptFinder::Impl::reserve() {
  const std::size_t count = is_static.size();
  const KeptCounts no_counts[2];
  const BoxMeasure of_none[2];
  BROADSIDE_TRY(now.reserve(count, "boxes"));
  BROADSIDE_TRY(placed.reserve(count, "boxes by place"));
  BROADSIDE_TRY(place_of.reserve(count, "places of boxes"));
  BROADSIDE_TRY(counts.upload(no_counts, "counts of kept pairs"));
  BROADSIDE_TRY(measures.upload(of_none, "measures of fat boxes"));
  BROADSIDE_TRY(counted.allocate());
  BROADSIDE_TRY(measured.allocate());
  view = {};
  view.count = static_cast<std::uint32_t>(count);
  view.now = now.data();
  view.measure = measures.data() + 1;
  view.placed = placed.data();
  view.place_of = place_of.data();
  view.counts = counts.data() + 1;
  return wait_for_device("making room for kept pairs");
}

core::Status KeptFinder::Impl::clear_counts() {
  return copy_on_device(view.counts, counts.data(), sizeof(KeptCounts), stream.get());
}

core::Status KeptFinder::Impl::read_counts(const char* what) {
  BROADSIDE_TRY(start_copy_to_host(&counted[0], view.counts, sizeof(KeptCounts), stream.get()));
  return stream.wait(what);
}

// Finds out whether every box is within its fat one. `given`: boxes on the device; null: they are packed already.
core::Status KeptFinder::Impl::look_within(const float* given) {
  is_kept = false;
  if (!has_candidates) return core::Done{};
  view.given = given;
  BROADSIDE_TRY(clear_counts());
  BROADSIDE_TRY(launch_within(view, stream.get()));
  BROADSIDE_TRY(read_counts("looking whether boxes are within"));
  is_kept = counted[0].left == 0;
  return core::Done{};
}

// Makes the fat boxes. If one reaches beyond the largest float, or is longer than any cell, is_fat stays false and the
// boxes are searched as they are.
core::Status KeptFinder::Impl::fatten() {
  auto room = fat.room_for(view.count);
  if (!room.ok()) return room.error();
  view.fat = room.value();
  BROADSIDE_TRY(copy_on_device(view.measure, measures.data(), sizeof(BoxMeasure), stream.get()));
  BROADSIDE_TRY(launch_fatten(view, stream.get()));
  BROADSIDE_TRY(start_copy_to_host(&measured[0], view.measure, sizeof(BoxMeasure), stream.get()));
  BROADSIDE_TRY(stream.wait("fattening boxes"));
  is_fat = measured[0].first_bad >= view.count;
  if (!is_fat) return core::Done{};
  BROADSIDE_TRY(fat.load_packed(facts_of(measured[0], view.count), fat_options, false));
  is_fat = fat.can_share();
  return core::Done{};
}

// Chooses how to search a frame that needs a search, once its boxes are packed.
core::Status KeptFinder::Impl::choose() {
  if (has_candidates) {
    in_vain = has_served ? 0 : in_vain + 1;
    if (in_vain > 0) pause = std::min(kMostPause, 1U << std::min(in_vain, 6U));
  }
  has_candidates = is_fat = false;
  if (pause > 0)
    --pause;
  else if (view.count > 1)
    BROADSIDE_TRY(fatten());
  has_served = has_served && !is_fat;
  return core::Done{};
}

core::Status KeptFinder::load(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  BROADSIDE_TRY(impl_->start(is_static));
  return update(boxes);
}

core::Status KeptFinder::update(std::span<const Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size()) return another_count(boxes.size(), d.is_static.size());
  if (d.looks()) {
    BROADSIDE_TRY(d.packed.take(boxes, d.is_static, d.fat_options));
    BROADSIDE_TRY(d.now.upload(d.packed.searched(), "boxes"));
    BROADSIDE_TRY(wait_for_device("copying boxes"));
  }
  BROADSIDE_TRY(d.look_within(nullptr));
  if (d.is_kept) return core::Done{};
  BROADSIDE_TRY(d.choose());
  if (d.is_fat) return core::Done{};
  const bool is_first = !d.is_plain;
  d.is_plain = true;
  return is_first ? d.plain.load(boxes, d.is_static) : d.plain.update(boxes);
}

core::Status KeptFinder::load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) {
  BROADSIDE_TRY(impl_->start(is_static));
  return update_on_device(boxes);
}

core::Status KeptFinder::update_on_device(const core::DeviceBoxes& boxes) {
  Impl& d = *impl_;
  if (boxes.count != d.is_static.size()) return another_count(boxes.count, d.is_static.size());
  BROADSIDE_TRY(d.packing.wait_behind(boxes, d.stream));
  BROADSIDE_TRY(d.look_within(boxes.data));
  if (d.is_kept) return core::Done{};
  if (d.looks())
    if (auto facts = d.packing.pack(boxes, d.is_static, d.now.data(), d.stream); !facts.ok()) return facts.error();
  BROADSIDE_TRY(d.choose());
  if (d.is_fat) return core::Done{};
  const bool is_first = !d.is_plain;
  d.is_plain = true;
  return is_first ? d.plain.load_on_device(boxes, d.is_static) : d.plain.update_on_device(boxes);
}

core::Status KeptFinder::Impl::search_fat() {
  NamedPairsView share;
  share.end_place = view.count;
  for (;;) {
    BROADSIDE_TRY(fat.launch_share(share, stream.get()));
    BROADSIDE_TRY(stream.wait("finding candidates"));
    if (!fat.is_aborted()) break;
    BROADSIDE_TRY(fat.grow());
  }
  view.order = fat.view().bulk.entries;
  view.candidates = fat.view().pairs.items;
  view.candidate_count = fat.found().count;
  BROADSIDE_TRY(launch_place(view, stream.get()));
  BROADSIDE_TRY(launch_renumber(view, stream.get()));
  has_candidates = true;
  return core::Done{};
}

core::Status KeptFinder::Impl::test_candidates() {
  // There are never more pairs than candidates.
  BROADSIDE_TRY(pairs.reserve(std::max(kLeastPairs, view.candidate_count), "pairs"));
  view.pairs = {pairs.data(), pairs.capacity()};
  BROADSIDE_TRY(clear_counts());
  BROADSIDE_TRY(launch_test(view, stream.get()));
  BROADSIDE_TRY(read_counts("testing candidates"));
  candidates_tested += view.candidate_count;
  pair_count = counted[0].pairs;
  return core::Done{};
}

core::Status KeptFinder::find() {
  Impl& d = *impl_;
  if (d.is_kept) {
    d.has_served = true;
    ++d.kept_frames;
    return d.test_candidates();
  }
  ++d.searched_frames;
  if (!d.is_fat) return d.plain.find();
  BROADSIDE_TRY(d.search_fat());
  return d.test_candidates();
}

core::Result<core::PairSet> KeptFinder::read_back() {
  if (!impl_->is_kept && !impl_->is_fat) return impl_->plain.read_back();
  core::PairSet set;
  BROADSIDE_TRY(impl_->pairs.download(set.pairs, impl_->pair_count));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

core::Result<core::DevicePairs> KeptFinder::pairs_on_device() const {
  if (!impl_->is_kept && !impl_->is_fat) return impl_->plain.pairs_on_device();
  auto device = current_device();
  if (!device.ok()) return device.error();
  return core::DevicePairs{impl_->pairs.data(), impl_->pair_count, device.value()};
}

std::vector<core::Counter> KeptFinder::counters() const {
  return {{"broad: candidates tested", impl_->candidates_tested},
          {"broad: frames searched", impl_->searched_frames},
          {"broad: frames of kept pairs", impl_->kept_frames}};
}

std::string KeptFinder::path() const {
  return std::to_string(impl_->searched_frames) + " frames searched, " + std::to_string(impl_->kept_frames) +
         " from pairs that were kept";
}

}  // namespace broadside::gpu
