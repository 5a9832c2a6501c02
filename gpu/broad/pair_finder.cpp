#include "gpu/broad/pair_finder.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"
#include "gpu/work/work_counter.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

// Some eight overlaps a box in the densest scenes of the campaign; a frame that finds more is found again.
constexpr std::uint64_t kPairsPerBox = 8;

}  // namespace

struct PairFinder::Impl {
  PairFinderOptions options;
  Stream stream;
  StreamTimer timer;
  Mapped<Outcome, 1> outcome;
  PairsShape launch;
  PairsView view;
  BoxFacts facts;
  std::vector<std::uint8_t> is_static;
  std::vector<PackedBox> packed;
  Counters counts;
  std::uint64_t launches = 0;
  std::uint64_t bytes_to_device = 0;
  DeviceBuffer<PackedBox> boxes;
  BroadBuffers broad;
  WorkCounter work;
  DeviceBuffer<core::Pair> pairs;
  DeviceBuffer<Counters> counters;
  DeviceBuffer<unsigned long long> barrier;

  [[nodiscard]] Start start() const;
  core::Status reserve();
  core::Status pack_boxes(std::span<const Box> given);
  core::Status upload();
};

PairFinder::PairFinder(const PairFinderOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
PairFinder::~PairFinder() = default;

core::BroadPhaseTraits PairFinder::traits() const {
  core::BroadPhaseTraits traits;
  traits.exact = impl_->options.variant != core::Variant::kE2;
  return traits;
}

Start PairFinder::Impl::start() const {
  if (options.variant == core::Variant::kE2 || options.variant == core::Variant::kE7) return Start::kOctree;
  if (options.broad == Broad::kOctree) return Start::kOctree;
  if (options.broad == Broad::kHash) return Start::kHash;
  if (options.broad != Broad::kTree || is_static.size() < options.least_for_grid || !fits_grid(facts))
    return Start::kTiles;
  return is_static.size() < options.least_for_bulk ? Start::kGrid : Start::kBulk;
}

core::Status PairFinder::Impl::reserve() {
  const std::size_t count = is_static.size();
  BROADSIDE_TRY(stream.create());
  BROADSIDE_TRY(outcome.allocate());
  BROADSIDE_TRY(boxes.reserve(count, "boxes"));
  BROADSIDE_TRY(counters.reserve(1, "counters"));
  BROADSIDE_TRY(barrier.reserve(1, "barrier"));
  BROADSIDE_TRY(barrier.fill_bytes(0));
  BROADSIDE_TRY(work.reset());
  BROADSIDE_TRY(pairs.reserve(std::max<std::uint64_t>(1024, kPairsPerBox * count), "pairs"));
  auto shape =
      pairs_launch_shape(start(), facts.count, static_cast<std::uint32_t>(grid_buckets(count)), options.least_for_bins);
  if (!shape.ok()) return shape.error();
  launch = shape.value();
  BROADSIDE_TRY(broad.load(start(), facts, options.hash_cell_m, options.variant, launch.bins, launch.sort.blocks));
  view.box_count = static_cast<std::uint32_t>(count);
  view.boxes = boxes.data();
  view.counters = counters.data();
  view.barrier = barrier.data();
  view.outcome = outcome.device(0);
  return wait_for_device("clearing the broad phase");
}

// Checks and packs, and learns what the cells' sizes depend on.
core::Status PairFinder::Impl::pack_boxes(std::span<const Box> given) {
  packed.resize(given.size());
  facts = {};
  facts.count = static_cast<std::uint32_t>(given.size());
  Box bounds = core::empty_box();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Box& box = given[i];
    for (int k = 0; k < 3; ++k) {
      if (!(std::isfinite(box.min[k]) && std::isfinite(box.max[k]) && box.min[k] <= box.max[k]))
        return core::Error{"a box has min > max, or is NaN or infinite", "box " + std::to_string(i),
                           "give finite boxes with min <= max"};
      facts.largest_side_m = std::max(facts.largest_side_m, box.max[k] - box.min[k]);
      facts.coordinate_range_m = std::max({facts.coordinate_range_m, std::abs(box.min[k]), std::abs(box.max[k])});
    }
    bounds = core::grown(core::grown(bounds, box.min), box.max);
    if (options.broad == Broad::kHash) facts.hash_entries += hash_cells_of(box.max - box.min, options.hash_cell_m);
    packed[i] = pack(box, static_cast<std::uint32_t>(i), is_static[i] != 0 ? 1U : 0U);
  }
  if (!given.empty()) {
    facts.low_corner = bounds.min;
    facts.domain = bounds;
  }
  return core::Done{};
}

core::Status PairFinder::Impl::upload() {
  bytes_to_device += packed.size() * sizeof(PackedBox);
  return boxes.upload(packed, "boxes");
}

core::Status PairFinder::load(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  Impl& d = *impl_;
  d.is_static.assign(is_static.begin(), is_static.end());
  BROADSIDE_TRY(d.pack_boxes(boxes));
  BROADSIDE_TRY(d.reserve());
  d.launches = d.bytes_to_device = 0;
  return d.upload();
}

core::Status PairFinder::update(std::span<const Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size())
    return core::Error{"update was given " + std::to_string(boxes.size()) + " boxes after a load of " +
                           std::to_string(d.is_static.size()),
                       "broad phase on the GPU", "load again when the number of boxes changes"};
  const Start before = d.start();
  BROADSIDE_TRY(d.pack_boxes(boxes));
  if (d.start() != before) BROADSIDE_TRY(d.reserve());
  d.broad.refit(d.facts);
  return d.upload();
}

core::Status PairFinder::find() {
  Impl& d = *impl_;
  for (;;) {
    d.broad.fill(d.view.broad);
    d.broad.fill(d.view.bulk);
    d.view.pairs = {d.pairs.data(), d.pairs.capacity()};
    BROADSIDE_TRY(d.timer.start(d.stream.get()));
    d.launches += d.launch.bins != 0 ? 2 : 1;
    BROADSIDE_TRY(launch_pairs(d.view, d.launch, d.stream.get()));
    BROADSIDE_TRY(d.timer.stop(d.stream.get()));
    BROADSIDE_TRY(d.stream.wait("finding pairs"));
    d.counts = d.outcome[0].counters;
    if (d.counts.is_aborted == 0)
      return d.work.count_broad({d.view.broad, d.view.bulk, d.view.boxes, d.view.box_count, d.view.counters},
                                d.launch.search.multiprocessors, d.stream.get());
    BROADSIDE_TRY(d.broad.grow(d.counts));
    BROADSIDE_TRY(d.pairs.reserve(d.counts.pairs, "pairs"));
  }
}

core::Result<core::PairSet> PairFinder::read_back() {
  core::PairSet set;
  BROADSIDE_TRY(impl_->pairs.download(set.pairs, impl_->counts.pairs));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

std::vector<core::Counter> PairFinder::counters() const {
  const Impl& d = *impl_;
  std::vector<core::Counter> counters{{"launches", d.launches},
                                      {"bytes to the device", d.bytes_to_device},
                                      {"device bytes", d.boxes.bytes() + d.broad.bytes() + d.pairs.bytes()}};
  d.work.tell(counters);
  return counters;
}

void PairFinder::count_work() {
  impl_->work.ask();
}

FindTime PairFinder::find_time() const {
  const Outcome& outcome = impl_->outcome[0];
  const auto seconds = [&outcome](FindStep step) {
    const auto k = static_cast<std::size_t>(step);
    const unsigned long long begin_ns = k == 0 ? outcome.begin_ns : outcome.stage_end_ns[k - 1];
    return static_cast<double>(outcome.stage_end_ns[k] - begin_ns) * 1e-9;
  };
  return {impl_->timer.elapsed_s(), seconds(FindStep::kCount), seconds(FindStep::kPlace), seconds(FindStep::kScatter),
          seconds(FindStep::kSearch)};
}

}  // namespace broadside::gpu
