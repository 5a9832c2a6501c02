#include "gpu/broad/pair_finder.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "gpu/broad/apart_search.hpp"
#include "gpu/broad/box_search.hpp"
#include "gpu/broad/dealt_boxes.hpp"
#include "gpu/broad/device_packing.hpp"
#include "gpu/broad/fitted_cells.hpp"
#include "gpu/broad/pair_chunks.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {

using core::Box;

struct PairFinder::Impl {
  PairFinderOptions options;
  Stream stream;
  StreamTimer timer;
  std::vector<std::uint8_t> is_static;
  core::PassPlan plan;
  SearchedBoxes boxes;
  DevicePacking packing;
  // The first `active` of these are in use, in order; the others keep their memory for another plan.
  std::vector<std::unique_ptr<BoxSearch>> searches;
  std::size_t active = 0;
  ApartSearch apart;
  bool may_be_apart = false;
  bool is_apart = false;  // `apart` is used instead of the searches
  std::uint64_t chunked_pairs = 0;
  BulkFit fit;                     // fit of the boxes that were loaded
  std::vector<BulkFit> pass_fits;  // fits of their passes
  bool is_by_host = false;         // the loaded boxes lie on the device and need passes, which the host makes
  std::uint64_t launches = 0;
  std::uint64_t bytes_to_device = 0;
  WorkCounter work;
  DeviceBuffer<core::Pair> joined;  // the pairs of several searches
  FoundPairs all;                   // set once the pairs of all searches were asked for together
  bool is_joined = false;

  core::Status start(std::span<const std::uint8_t> flags);
  core::Status place(std::span<const Box> given, bool is_new);
  core::Status place_on_device(const core::DeviceBoxes& given, bool is_new);
  core::Status fit_to(const core::DeviceBoxes& given, const BoxFacts& facts);
  core::Status place_by_host(const core::DeviceBoxes& given, bool is_new);
  core::Status load_search(std::size_t k, bool is_new, const PairFinderOptions& own);
  [[nodiscard]] BulkFit with_wishes(BulkFit own) const;
  BoxSearch& search(std::size_t k);
  core::Status launch();
  core::Result<bool> grow();
  [[nodiscard]] std::vector<FoundPairs> found() const;
  core::Status join();
  core::Status for_each_chunk(const ChunkConsumer& take);
  [[nodiscard]] std::uint32_t least_for_passes() const {
    return std::max(options.least_for_grid, options.least_for_passes);
  }
  [[nodiscard]] std::string words_of_search() const;
  [[nodiscard]] bool is_chunked() const { return options.pairs_at_once != 0; }
};

PairFinder::PairFinder(const PairFinderOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  impl_->options.has_shares = options.has_shares || options.pairs_at_once != 0;
}
PairFinder::~PairFinder() = default;

core::BroadPhaseTraits PairFinder::traits() const {
  core::BroadPhaseTraits traits;
  traits.exact = impl_->options.variant != core::Variant::kE2;
  return traits;
}

core::Status PairFinder::Impl::start(std::span<const std::uint8_t> flags) {
  BROADSIDE_TRY(check_box_limit(flags.size()));
  is_static.assign(flags.begin(), flags.end());
  packing.start();
  is_by_host = false;
  launches = bytes_to_device = 0;
  may_be_apart = !is_chunked() && options.may_have_passes() && is_worth_keeping_apart(is_static, options);
  if (may_be_apart) apart.start(is_static, options);
  BROADSIDE_TRY(stream.create());
  return work.reset();
}

BoxSearch& PairFinder::Impl::search(std::size_t k) {
  if (searches.size() <= k) searches.push_back(std::make_unique<BoxSearch>());
  return *searches[k];
}

core::Status PairFinder::Impl::load_search(std::size_t k, bool is_new, const PairFinderOptions& own) {
  bytes_to_device += (boxes.searched().size() + boxes.given().size()) * sizeof(PackedBox);
  return search(k).load(boxes, own, is_new);
}

// Replaces what was fitted by what the options say.
BulkFit PairFinder::Impl::with_wishes(BulkFit own) const {
  if (options.cell_scale != 0.0F) own.cell_scale = options.cell_scale;
  if (options.lanes_per_box != 0) own.lanes_per_box = options.lanes_per_box;
  if (options.levels_apart != 0) own.levels_apart = options.levels_apart;
  if (options.x_halvings != PairFinderOptions::kFitted) own.x_halvings = options.x_halvings;
  if (options.groups != PairFinderOptions::kFitted) own.is_grouped = options.groups != 0;
  // Work is counted for the search by cells only: which boxes a group has differs from run to run.
  if (work.is_asked() || options.has_shares) own.is_grouped = false;
  return own;
}

core::Status PairFinder::Impl::place(std::span<const Box> given, bool is_new) {
  // Done even if there are passes, because take() refuses what is not a box.
  BROADSIDE_TRY(boxes.take(given, is_static, options));
  plan = {};
  if (options.may_have_passes()) plan = core::plan_passes(given, boxes.facts().coordinate_range_m, least_for_passes());
  is_apart = false;
  if (may_be_apart && plan.is_plain()) {
    auto can_be = apart.load(given, stream);
    if (!can_be.ok()) return can_be.error();
    is_apart = can_be.value();
    if (is_apart) return core::Done{};
  }
  active = std::max<std::size_t>(1, plan.passes.size());
  if (plan.is_plain()) {
    // Fitting pays only over several frames, so updates keep the fit of the boxes that were loaded.
    const bool is_bulk = options.start(boxes.facts()) == Start::kBulk;
    if (is_new) fit = with_wishes(is_bulk ? bulk_fit(given, boxes.facts()) : BulkFit{});
    boxes.fit(fit);
    return load_search(0, is_new, options);
  }
  PairFinderOptions own = options;
  if (plan.is_logarithmic()) own.least_for_bulk = std::min(own.least_for_bulk, kLeastBoxesOfExponentsForBulk);
  pass_fits.resize(active);
  for (std::size_t k = 0; k < active; ++k) {
    boxes.take(given, is_static, plan, plan.passes[k]);
    const bool is_bulk = own.start(boxes.facts()) == Start::kBulk;
    if (is_new && is_bulk) pass_fits[k] = with_wishes(bulk_fit_by_sample(boxes.sample(), boxes.facts()));
    pass_fits[k].cell_scale = 1.0F;  // a pass has made its boxes as large as cells
    pass_fits[k].is_grouped = false;
    boxes.fit(pass_fits[k]);
    BROADSIDE_TRY(load_search(k, is_new, own));
  }
  return core::Done{};
}

// Decides from a sample, as for boxes of the host, whether there are passes and how large cells are.
core::Status PairFinder::Impl::fit_to(const core::DeviceBoxes& given, const BoxFacts& facts) {
  is_by_host = false;
  if (options.may_have_passes()) {
    auto sample = packing.gather(given, core::boxes_to_plan_by(facts.count, least_for_passes()), stream);
    if (!sample.ok()) return sample.error();
    is_by_host = !core::plan_passes_by_sample(sample.value(), facts.count, facts.coordinate_range_m).is_plain();
  }
  fit = with_wishes({});
  if (is_by_host || options.start(facts) != Start::kBulk) return core::Done{};
  auto sample = packing.gather(given, boxes_to_fit_by(facts.count), stream);
  if (!sample.ok()) return sample.error();
  fit = with_wishes(bulk_fit_by_sample(sample.value(), facts));
  return core::Done{};
}

core::Status PairFinder::Impl::place_by_host(const core::DeviceBoxes& given, bool is_new) {
  BROADSIDE_TRY(packing.wait_behind(given, stream));
  BROADSIDE_TRY(stream.wait("writing boxes"));
  std::vector<Box> copied(given.count);
  if (given.count != 0) BROADSIDE_TRY(copy_to_host(copied.data(), given.data, given.count * sizeof(Box)));
  return place(copied, is_new);
}

core::Status PairFinder::Impl::place_on_device(const core::DeviceBoxes& given, bool is_new) {
  if (options.broad == Broad::kHash)
    return core::Error{"it takes boxes only from the host", "spatial hash on the GPU",
                       "take octree-gpu, or copy the boxes to the host"};
  if (!is_new && is_by_host) return place_by_host(given, false);
  plan = {};
  is_apart = false;
  active = 1;
  auto room = search(0).room_for(given.count);
  if (!room.ok()) return room.error();
  auto facts = packing.pack(given, is_static, room.value(), stream);
  if (!facts.ok()) return facts.error();
  BoxFacts fitted = facts.value();
  if (is_new) BROADSIDE_TRY(fit_to(given, fitted));
  if (is_by_host) return place_by_host(given, is_new);
  fitted.fit = fit;
  return search(0).load_packed(fitted, options, is_new);
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

core::Status PairFinder::Impl::launch() {
  if (is_apart) {
    launches += apart.launches();
    return apart.launch(stream.get());
  }
  for (std::size_t k = 0; k < active; ++k) {
    launches += searches[k]->launches();
    BROADSIDE_TRY(searches[k]->launch(stream.get()));
  }
  return core::Done{};
}

// Returns whether there was too little room; afterwards there is enough.
core::Result<bool> PairFinder::Impl::grow() {
  bool had_too_little = false;
  const auto grow_one = [&](auto& search) -> core::Status {
    if (!search.is_aborted()) return core::Done{};
    had_too_little = true;
    return search.grow();
  };
  if (is_apart) BROADSIDE_TRY(grow_one(apart));
  if (!is_apart)
    for (std::size_t k = 0; k < active; ++k) BROADSIDE_TRY(grow_one(*searches[k]));
  return had_too_little;
}

std::vector<FoundPairs> PairFinder::Impl::found() const {
  if (is_apart) return {apart.found()};
  std::vector<FoundPairs> all_found;
  for (std::size_t k = 0; k < active; ++k) all_found.push_back(searches[k]->found());
  return all_found;
}

core::Status PairFinder::Impl::for_each_chunk(const ChunkConsumer& take) {
  for (std::size_t k = 0; k < active; ++k) BROADSIDE_TRY(gpu::for_each_chunk(*searches[k], stream, take, launches));
  return core::Done{};
}

core::Status PairFinder::find() {
  Impl& d = *impl_;
  d.is_joined = false;
  if (d.is_chunked()) {
    d.chunked_pairs = 0;
    BROADSIDE_TRY(d.timer.start(d.stream.get()));
    BROADSIDE_TRY(d.for_each_chunk([&d](const FoundPairs& chunk) -> core::Status {
      d.chunked_pairs += chunk.count;
      return core::Done{};
    }));
    BROADSIDE_TRY(d.timer.stop(d.stream.get()));
    return d.stream.wait("finding pairs");
  }
  for (bool is_complete = false; !is_complete;) {
    BROADSIDE_TRY(d.timer.start(d.stream.get()));
    BROADSIDE_TRY(d.launch());
    BROADSIDE_TRY(d.timer.stop(d.stream.get()));
    BROADSIDE_TRY(d.stream.wait("finding pairs"));
    auto had_too_little = d.grow();
    if (!had_too_little.ok()) return had_too_little.error();
    is_complete = !had_too_little.value();
  }
  if (!d.is_apart)
    for (std::size_t k = 0; k < d.active; ++k) BROADSIDE_TRY(d.searches[k]->count_work(d.work, d.stream.get()));
  return core::Done{};
}

core::Status PairFinder::hand_on(const Consumer& take) {
  Impl& d = *impl_;
  auto device = current_device();
  if (!device.ok()) return device.error();
  const auto hand = [&](const FoundPairs& chunk) { return take({chunk.data, chunk.count, device.value()}); };
  if (d.is_chunked()) return d.for_each_chunk(hand);
  BROADSIDE_TRY(find());
  for (const FoundPairs& own : d.found()) BROADSIDE_TRY(hand(own));
  return core::Done{};
}

// The pairs of a single search stay where they are; those of several searches are copied into one array.
core::Status PairFinder::Impl::join() {
  if (is_joined) return core::Done{};
  const std::vector<FoundPairs> each = found();
  all = {};
  if (each.size() == 1) all = each[0];
  if (each.size() > 1) {
    for (const FoundPairs& own : each) all.count += own.count;
    BROADSIDE_TRY(joined.reserve(all.count, "pairs"));
    all.data = joined.data();
    core::Pair* to = joined.data();
    for (const FoundPairs& own : each) {
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
  if (impl_->is_chunked())
    return core::Error{"pairs are handed on in chunks, so no list of all of them exists", "broad phase on the GPU",
                       "take them by hand_on, or leave out pairs_at_once"};
  BROADSIDE_TRY(impl_->join());
  return core::DevicePairs{impl_->all.data, impl_->all.count, device.value()};
}

core::Result<core::PairSet> PairFinder::read_back() {
  core::PairSet set;
  const auto append = [&set](const FoundPairs& from) -> core::Status {
    const std::size_t before = set.pairs.size();
    set.pairs.resize(before + from.count);
    if (from.count == 0) return core::Done{};
    return copy_to_host(set.pairs.data() + before, from.data, from.count * sizeof(core::Pair));
  };
  if (impl_->is_chunked()) BROADSIDE_TRY(impl_->for_each_chunk(append));
  if (!impl_->is_chunked())
    for (const FoundPairs& own : impl_->found()) BROADSIDE_TRY(append(own));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

std::vector<core::Counter> PairFinder::counters() const {
  const Impl& d = *impl_;
  std::uint64_t bytes = d.joined.bytes() + d.apart.bytes();
  for (const auto& search : d.searches) bytes += search->bytes();
  std::vector<core::Counter> counters{{"launches", d.launches},
                                      {"bytes to the device", d.bytes_to_device + d.apart.bytes_to_device()},
                                      {"device bytes", bytes}};
  if (d.is_apart) {
    counters.push_back({"broad: static tables built", d.apart.static_builds()});
    counters.push_back({"broad: static boxes kept", d.apart.static_boxes_kept()});
  }
  d.work.tell(counters);
  return counters;
}

void PairFinder::count_work() {
  impl_->work.ask();
}

// Describes the search. For bulk pairs it also says, pass by pass, how large cells are and how many lanes look for a
// box's partners.
std::string PairFinder::Impl::words_of_search() const {
  std::string words = core::words_of(plan);
  if (active == 0 || active > searches.size()) return words;
  if (searches[0]->start() == Start::kTiles) return words + ", every pair of them";
  if (searches[0]->start() != Start::kBulk) return words;
  if (searches[0]->is_grouped()) return words + "; groups of neighboring boxes";
  char cells[100];
  std::snprintf(cells, sizeof cells, "cells %.3g times as long as the longest, %s%s",
                static_cast<double>(fit.cell_scale), fit.levels_apart == 4 ? "levels four octaves apart, " : "",
                fit.x_halvings != 0 ? "halved in x, " : "");
  words += (plan.is_plain() ? std::string("; ") + cells : "; ") + "lanes a box:";
  for (std::size_t k = 0; k < active; ++k) words += " " + std::to_string(searches[k]->lanes_per_box());
  return words;
}

std::string PairFinder::path() const {
  if (impl_->is_apart) return "static boxes in a table that is kept, moving ones in a table of each frame";
  return impl_->words_of_search();
}

const core::PassPlan& PairFinder::plan() const {
  return impl_->plan;
}

FindTime PairFinder::find_time() const {
  FindTime time;
  time.whole_s = impl_->timer.elapsed_s();
  if (impl_->is_apart) time.add_steps(impl_->apart.outcome());
  if (!impl_->is_apart)
    for (std::size_t k = 0; k < impl_->active; ++k) time.add_steps(impl_->searches[k]->outcome());
  return time;
}

}  // namespace broadside::gpu
