#include "gpu/broad/pair_finder.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/broad/pack_view.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"
#include "gpu/work/work_counter.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

// Some eight overlaps a box in the densest scenes of the campaign; a frame that finds more is found again.
constexpr std::uint64_t kPairsPerBox = 8;

core::Error bad_box(std::size_t place) {
  return {"a box has min > max, or is NaN or infinite", "box " + std::to_string(place),
          "give finite boxes with min <= max"};
}

core::Error another_count(std::size_t given, std::size_t loaded) {
  return {"update was given " + std::to_string(given) + " boxes after a load of " + std::to_string(loaded),
          "broad phase on the GPU", "load again when the number of boxes changes"};
}

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
  DeviceBuffer<std::uint8_t> flags;   // is_static, where boxes come from the device
  DeviceBuffer<BoxMeasure> measures;  // that of no box, which each packing begins with, and that of the last boxes
  Mapped<BoxMeasure, 1> measured;
  bool has_flags = false;  // and the measure of no box
  StreamMark written;
  BroadBuffers broad;
  WorkCounter work;
  DeviceBuffer<core::Pair> pairs;
  DeviceBuffer<Counters> counters;
  DeviceBuffer<unsigned long long> barrier;

  [[nodiscard]] Start start() const;
  core::Status reserve();
  core::Status pack_boxes(std::span<const Box> given);
  core::Status upload();
  core::Status reserve_packing();
  core::Status pack_on_device(const core::DeviceBoxes& given);
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
      if (!(std::isfinite(box.min[k]) && std::isfinite(box.max[k]) && box.min[k] <= box.max[k])) return bad_box(i);
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
  d.has_flags = false;
  BROADSIDE_TRY(d.pack_boxes(boxes));
  BROADSIDE_TRY(d.reserve());
  d.launches = d.bytes_to_device = 0;
  return d.upload();
}

core::Status PairFinder::update(std::span<const Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size()) return another_count(boxes.size(), d.is_static.size());
  const Start before = d.start();
  BROADSIDE_TRY(d.pack_boxes(boxes));
  if (d.start() != before) BROADSIDE_TRY(d.reserve());
  d.broad.refit(d.facts);
  return d.upload();
}

// Copies of the host go their own way: they are waited for before the stream's work begins.
core::Status PairFinder::Impl::reserve_packing() {
  const BoxMeasure of_none[2];
  BROADSIDE_TRY(flags.upload(is_static, "flags of static boxes"));
  BROADSIDE_TRY(measures.upload(of_none, "measures of boxes"));
  BROADSIDE_TRY(measured.allocate());
  BROADSIDE_TRY(wait_for_device("copying flags of static boxes"));
  has_flags = true;
  return core::Done{};
}

// As pack_boxes and upload, of boxes that the host never sees.
core::Status PairFinder::Impl::pack_on_device(const core::DeviceBoxes& given) {
  if (options.broad == Broad::kHash)
    return core::Error{"it takes boxes from the host alone", "spatial hash on the GPU",
                       "take octree-gpu, or copy the boxes to the host"};
  if (!has_flags) BROADSIDE_TRY(reserve_packing());
  if (given.count != 0 && given.is_behind_stream) {
    BROADSIDE_TRY(written.set(static_cast<StreamHandle>(given.stream)));
    BROADSIDE_TRY(written.hold_back(stream.get()));
  }
  BoxMeasure* const measure = measures.data() + 1;
  BROADSIDE_TRY(copy_on_device(measure, measures.data(), sizeof *measure, stream.get()));
  PackView pack;
  pack.count = static_cast<std::uint32_t>(given.count);
  pack.given = given.data;
  pack.is_static = flags.data();
  pack.packed = boxes.data();
  pack.measure = measure;
  BROADSIDE_TRY(launch_pack(pack, stream.get()));
  BROADSIDE_TRY(start_copy_to_host(&measured[0], measure, sizeof *measure, stream.get()));
  BROADSIDE_TRY(stream.wait("packing boxes"));
  facts = {};
  facts.count = pack.count;
  if (given.count == 0) return core::Done{};
  const BoxMeasure& m = measured[0];
  if (m.first_bad < given.count) return bad_box(m.first_bad);
  facts.largest_side_m = from_ordered_bits(m.largest_side);
  facts.coordinate_range_m = from_ordered_bits(m.coordinate_range);
  for (int k = 0; k < 3; ++k) {
    facts.domain.min[k] = from_ordered_bits(m.low[k]);
    facts.domain.max[k] = from_ordered_bits(m.high[k]);
  }
  facts.low_corner = facts.domain.min;
  return core::Done{};
}

core::Status PairFinder::load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) {
  Impl& d = *impl_;
  d.is_static.assign(is_static.begin(), is_static.end());
  d.has_flags = false;
  BROADSIDE_TRY(d.stream.create());
  BROADSIDE_TRY(d.boxes.reserve(boxes.count, "boxes"));
  BROADSIDE_TRY(d.pack_on_device(boxes));
  BROADSIDE_TRY(d.reserve());
  d.launches = d.bytes_to_device = 0;
  return core::Done{};
}

core::Status PairFinder::update_on_device(const core::DeviceBoxes& boxes) {
  Impl& d = *impl_;
  if (boxes.count != d.is_static.size()) return another_count(boxes.count, d.is_static.size());
  const Start before = d.start();
  BROADSIDE_TRY(d.pack_on_device(boxes));
  if (d.start() != before) BROADSIDE_TRY(d.reserve());
  d.broad.refit(d.facts);
  return core::Done{};
}

core::Result<core::DevicePairs> PairFinder::pairs_on_device() const {
  auto device = current_device();
  if (!device.ok()) return device.error();
  return core::DevicePairs{impl_->pairs.data(), impl_->counts.pairs, device.value()};
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
