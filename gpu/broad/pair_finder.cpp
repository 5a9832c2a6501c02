#include "gpu/broad/pair_finder.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "gpu/broad/box_search.hpp"
#include "gpu/broad/device_packing.hpp"
#include "gpu/broad/pack_view.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

core::Error another_count(std::size_t given, std::size_t loaded) {
  return {"update was given " + std::to_string(given) + " boxes after a load of " + std::to_string(loaded),
          "broad phase on the GPU", "load again when the number of boxes changes"};
}

}  // namespace

struct PairFinder::Impl {
  PairFinderOptions options;
  Stream stream;
  StreamTimer timer;
  std::vector<std::uint8_t> is_static;
  core::PassPlan plan;
  SearchedBoxes boxes;
  DevicePacking packing;
  // The first `active`, in their order; the others keep their memory for another plan.
  std::vector<std::unique_ptr<BoxSearch>> searches;
  std::size_t active = 0;
  std::uint64_t launches = 0;
  std::uint64_t bytes_to_device = 0;
  WorkCounter work;
  DeviceBuffer<core::Pair> joined;  // the pairs of several searches
  FoundPairs all;                   // once somebody asked for them together
  bool is_joined = false;

  core::Status start(std::span<const std::uint8_t> flags);
  core::Status place(std::span<const Box> given, bool is_new);
  core::Status place_on_device(const core::DeviceBoxes& given, bool is_new);
  core::Status load_search(std::size_t k, bool is_new);
  BoxSearch& search(std::size_t k);
  core::Status join();
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

core::Status PairFinder::Impl::start(std::span<const std::uint8_t> flags) {
  is_static.assign(flags.begin(), flags.end());
  packing.start();
  launches = bytes_to_device = 0;
  BROADSIDE_TRY(stream.create());
  return work.reset();
}

BoxSearch& PairFinder::Impl::search(std::size_t k) {
  if (searches.size() <= k) searches.push_back(std::make_unique<BoxSearch>());
  return *searches[k];
}

core::Status PairFinder::Impl::load_search(std::size_t k, bool is_new) {
  bytes_to_device += (boxes.searched().size() + boxes.given().size()) * sizeof(PackedBox);
  return search(k).load(boxes, options, is_new);
}

core::Status PairFinder::Impl::place(std::span<const Box> given, bool is_new) {
  // Also where there are passes: it refuses what is no box.
  BROADSIDE_TRY(boxes.take(given, is_static, options));
  plan = {};
  if (options.may_have_passes())
    plan = core::plan_passes(given, boxes.facts().coordinate_range_m,
                             std::max(options.least_for_grid, options.least_for_passes));
  active = std::max<std::size_t>(1, plan.passes.size());
  if (plan.is_plain()) return load_search(0, is_new);
  for (std::size_t k = 0; k < active; ++k) {
    boxes.take(given, is_static, plan, plan.passes[k]);
    BROADSIDE_TRY(load_search(k, is_new));
  }
  return core::Done{};
}

core::Status PairFinder::Impl::place_on_device(const core::DeviceBoxes& given, bool is_new) {
  if (options.broad == Broad::kHash)
    return core::Error{"it takes boxes from the host alone", "spatial hash on the GPU",
                       "take octree-gpu, or copy the boxes to the host"};
  plan = {};
  active = 1;
  auto room = search(0).room_for(given.count);
  if (!room.ok()) return room.error();
  auto facts = packing.pack(given, is_static, room.value(), stream);
  if (!facts.ok()) return facts.error();
  return search(0).load_packed(facts.value(), options, is_new);
}

core::Status PairFinder::load(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  BROADSIDE_TRY(impl_->start(is_static));
  return impl_->place(boxes, true);
}

core::Status PairFinder::update(std::span<const Box> boxes) {
  if (boxes.size() != impl_->is_static.size()) return another_count(boxes.size(), impl_->is_static.size());
  return impl_->place(boxes, false);
}

core::Status PairFinder::load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) {
  BROADSIDE_TRY(impl_->start(is_static));
  return impl_->place_on_device(boxes, true);
}

core::Status PairFinder::update_on_device(const core::DeviceBoxes& boxes) {
  if (boxes.count != impl_->is_static.size()) return another_count(boxes.count, impl_->is_static.size());
  return impl_->place_on_device(boxes, false);
}

core::Status PairFinder::find() {
  Impl& d = *impl_;
  d.is_joined = false;
  for (bool is_complete = false; !is_complete;) {
    BROADSIDE_TRY(d.timer.start(d.stream.get()));
    for (std::size_t k = 0; k < d.active; ++k) {
      d.launches += d.searches[k]->launches();
      BROADSIDE_TRY(d.searches[k]->launch(d.stream.get()));
    }
    BROADSIDE_TRY(d.timer.stop(d.stream.get()));
    BROADSIDE_TRY(d.stream.wait("finding pairs"));
    is_complete = true;
    for (std::size_t k = 0; k < d.active; ++k) {
      if (!d.searches[k]->is_aborted()) continue;
      is_complete = false;
      BROADSIDE_TRY(d.searches[k]->grow());
    }
  }
  for (std::size_t k = 0; k < d.active; ++k) BROADSIDE_TRY(d.searches[k]->count_work(d.work, d.stream.get()));
  return core::Done{};
}

// One search's pairs are where they are; those of several are copied behind each other.
core::Status PairFinder::Impl::join() {
  if (is_joined) return core::Done{};
  all = {};
  if (active == 1) all = searches[0]->found();
  if (active > 1) {
    for (std::size_t k = 0; k < active; ++k) all.count += searches[k]->found().count;
    BROADSIDE_TRY(joined.reserve(all.count, "pairs"));
    all.data = joined.data();
    core::Pair* to = joined.data();
    for (std::size_t k = 0; k < active; ++k) {
      const FoundPairs own = searches[k]->found();
      if (own.count != 0) BROADSIDE_TRY(copy_on_device(to, own.data, own.count * sizeof(core::Pair), stream.get()));
      to += own.count;
    }
    BROADSIDE_TRY(stream.wait("joining pairs"));
  }
  is_joined = true;
  return core::Done{};
}

core::Result<core::DevicePairs> PairFinder::pairs_on_device() const {
  auto device = current_device();
  if (!device.ok()) return device.error();
  BROADSIDE_TRY(impl_->join());
  return core::DevicePairs{impl_->all.data, impl_->all.count, device.value()};
}

core::Result<core::PairSet> PairFinder::read_back() {
  core::PairSet set;
  for (std::size_t k = 0; k < impl_->active; ++k) BROADSIDE_TRY(impl_->searches[k]->append_pairs(set.pairs));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

std::vector<core::Counter> PairFinder::counters() const {
  const Impl& d = *impl_;
  std::uint64_t bytes = d.joined.bytes();
  for (const auto& search : d.searches) bytes += search->bytes();
  std::vector<core::Counter> counters{
      {"launches", d.launches}, {"bytes to the device", d.bytes_to_device}, {"device bytes", bytes}};
  d.work.tell(counters);
  return counters;
}

void PairFinder::count_work() {
  impl_->work.ask();
}

std::string PairFinder::path() const {
  return core::words_of(impl_->plan);
}

const core::PassPlan& PairFinder::plan() const {
  return impl_->plan;
}

FindTime PairFinder::find_time() const {
  FindTime time;
  time.whole_s = impl_->timer.elapsed_s();
  for (std::size_t s = 0; s < impl_->active; ++s) {
    const Outcome& outcome = impl_->searches[s]->outcome();
    const auto seconds = [&outcome](FindStep step) {
      const auto k = static_cast<std::size_t>(step);
      const unsigned long long begin_ns = k == 0 ? outcome.begin_ns : outcome.stage_end_ns[k - 1];
      return static_cast<double>(outcome.stage_end_ns[k] - begin_ns) * 1e-9;
    };
    time.count_s += seconds(FindStep::kCount);
    time.place_s += seconds(FindStep::kPlace);
    time.scatter_s += seconds(FindStep::kScatter);
    time.find_s += seconds(FindStep::kSearch);
  }
  return time;
}

}  // namespace broadside::gpu
