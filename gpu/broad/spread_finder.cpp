#include "gpu/broad/spread_finder.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "gpu/broad/dealt_boxes.hpp"
#include "gpu/broad/part_search.hpp"
#include "gpu/broad/searched_boxes.hpp"

namespace broadside::gpu {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point& from) {
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - from).count();
  from = now;
  return seconds;
}

// The cut in the coordinates of a pass.
core::SpaceCut mapped(const core::SpaceCut& cut, const core::PassMap& map) {
  core::SpaceCut of_pass;
  while (map.from[of_pass.axis] != cut.axis) ++of_pass.axis;
  for (const float face : cut.faces) of_pass.faces.push_back(map.axis[cut.axis](face));
  return of_pass;
}

}  // namespace

// The boxes of one pass, or all boxes if there are no passes, dealt to parts.
struct SpreadSearch {
  core::SpaceCut cut;
  DealtBoxes dealt;
  std::vector<std::unique_ptr<PartSearch>> parts;
  std::uint64_t guests = 0;  // since load

  core::Status load(const PartOptions& options, std::uint32_t devices);
  core::Status find_borders(Numbers numbers);
  core::Status exchange();
  core::Status search();
};

struct SpreadFinder::Impl {
  SpreadOptions options;
  std::vector<std::uint8_t> is_static;
  core::SpaceCut cut;
  core::PassPlan plan;
  std::vector<SpreadSearch> searches;  // one for each pass, or a single one
  std::uint32_t devices = 0;
  BulkFit fit;  // of the boxes that were loaded
  SpreadTime time;
  std::uint64_t chunked_pairs = 0;

  core::Status deal(std::span<const core::Box> boxes, bool is_new);
  core::Status exchange_borders(Numbers numbers);
  core::Status for_each_chunk(const ChunkConsumer& take);
  [[nodiscard]] bool is_chunked() const { return options.pairs_at_once != 0; }
  [[nodiscard]] bool tells_callers() const { return is_chunked() || !plan.is_plain(); }
  template <typename What>
  void each_part(const What& what) const {
    for (const SpreadSearch& search : searches)
      for (const auto& part : search.parts) what(*part);
  }
};

SpreadFinder::SpreadFinder(const SpreadOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
SpreadFinder::~SpreadFinder() = default;

core::Status SpreadSearch::load(const PartOptions& options, std::uint32_t devices) {
  for (std::uint32_t k = 0; k < dealt.parts(); ++k) {
    BROADSIDE_TRY(check_box_limit(dealt.facts(k).count));
    if (parts.size() <= k) parts.push_back(std::make_unique<PartSearch>(static_cast<int>(k % devices), k));
    BROADSIDE_TRY(parts[k]->load(dealt, cut, options));
  }
  return core::Done{};
}

core::Status SpreadFinder::Impl::deal(std::span<const core::Box> boxes, bool is_new) {
  FactsOfBoxes facts;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_sound(boxes[i])) return bad_box(i);
    facts.add(boxes[i]);
  }
  plan = core::plan_passes(boxes, facts.all().coordinate_range_m, options.least_for_passes);
  searches.resize(std::max<std::size_t>(1, plan.passes.size()));
  PartOptions own{!plan.is_plain(), 0, options.pairs_at_once};
  if (plan.is_plain()) {
    SpreadSearch& all = searches[0];
    all.cut = cut;
    BROADSIDE_TRY(all.dealt.take(boxes, is_static, cut));
    if (is_new) fit = all.dealt.fitted(boxes);
    all.dealt.set_fit(fit);
    return all.load(own, devices);
  }
  for (std::size_t k = 0; k < searches.size(); ++k) {
    const core::BoxPass& pass = plan.passes[k];
    searches[k].cut = mapped(cut, pass.map);
    searches[k].dealt.take(boxes, is_static, searches[k].cut, plan, pass);
    own.owned = pass.owned;
    BROADSIDE_TRY(searches[k].load(own, devices));
  }
  return core::Done{};
}

core::Status SpreadFinder::load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) {
  auto devices = device_count();
  if (!devices.ok()) return devices.error();
  const auto all = static_cast<std::uint32_t>(devices.value());
  const std::uint32_t wanted = impl_->options.devices == 0 ? all : impl_->options.devices;
  return load_cut(boxes, is_static, core::cut_space(boxes, impl_->options.parts == 0 ? wanted : impl_->options.parts));
}

core::Status SpreadFinder::load_cut(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                                    const core::SpaceCut& cut) {
  Impl& d = *impl_;
  const DeviceScope scope;
  auto devices = device_count();
  if (!devices.ok()) return devices.error();
  const auto all = static_cast<std::uint32_t>(devices.value());
  if (d.options.devices > all)
    return core::Error{
        std::to_string(d.options.devices) + " devices are asked for, and there are " + std::to_string(all),
        "a set that is spread over devices", "ask for fewer", core::Exit::kMissing};
  d.devices = std::min(d.options.devices == 0 ? all : d.options.devices, cut.parts());
  for (std::uint32_t to = 0; to < d.devices; ++to)
    for (std::uint32_t from = 0; from < d.devices; ++from)
      BROADSIDE_TRY(let_reach(static_cast<int>(to), static_cast<int>(from)));
  d.is_static.assign(is_static.begin(), is_static.end());
  d.cut = cut;
  d.searches.clear();
  return d.deal(boxes, true);
}

core::Status SpreadFinder::update(std::span<const core::Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size()) return another_count(boxes.size(), d.is_static.size());
  const DeviceScope scope;
  return d.deal(boxes, false);
}

core::Status SpreadSearch::find_borders(Numbers numbers) {
  for (auto& part : parts) BROADSIDE_TRY(part->start_borders(numbers));
  for (auto& part : parts) {
    for (;;) {
      auto is_done = part->finish_borders();
      if (!is_done.ok()) return is_done.error();
      if (is_done.value()) break;
      BROADSIDE_TRY(part->start_borders(numbers));
    }
  }
  return core::Done{};
}

core::Status SpreadSearch::exchange() {
  for (std::uint32_t k = 0; k < parts.size(); ++k) {
    std::uint64_t count = 0;
    for (std::uint32_t from = 0; from < k; ++from) count += parts[from]->reaching(k);
    BROADSIDE_TRY(check_box_limit(dealt.facts(k).count + count));
    BROADSIDE_TRY(parts[k]->make_room_for_guests(count));
    guests += count;
    for (std::uint32_t from = 0; from < k; ++from) BROADSIDE_TRY(parts[k]->start_copy_from(*parts[from]));
  }
  return core::Done{};
}

core::Status SpreadSearch::search() {
  for (auto& part : parts) BROADSIDE_TRY(part->start_search());
  for (auto& part : parts) {
    for (;;) {
      auto is_done = part->finish_search();
      if (!is_done.ok()) return is_done.error();
      if (is_done.value()) break;
      BROADSIDE_TRY(part->start_search());
    }
  }
  return core::Done{};
}

core::Status SpreadFinder::Impl::exchange_borders(Numbers numbers) {
  auto at = Clock::now();
  for (SpreadSearch& search : searches) BROADSIDE_TRY(search.find_borders(numbers));
  time.borders_s = seconds_since(at);
  for (SpreadSearch& search : searches) BROADSIDE_TRY(search.exchange());
  time.exchange_s = seconds_since(at);
  return core::Done{};
}

// Goes through one part after another; a part's pairs stay in memory until they were taken.
core::Status SpreadFinder::Impl::for_each_chunk(const ChunkConsumer& take) {
  BROADSIDE_TRY(exchange_borders(Numbers::kCallers));
  auto at = Clock::now();
  for (SpreadSearch& search : searches)
    for (auto& part : search.parts) BROADSIDE_TRY(part->hand_on(take));
  time.search_s = seconds_since(at);
  return core::Done{};
}

core::Status SpreadFinder::find() {
  Impl& d = *impl_;
  const DeviceScope scope;
  if (d.is_chunked()) {
    d.chunked_pairs = 0;
    return d.for_each_chunk([&d](const FoundPairs& chunk) -> core::Status {
      d.chunked_pairs += chunk.count;
      return core::Done{};
    });
  }
  BROADSIDE_TRY(d.exchange_borders(Numbers::kDealt));
  auto at = Clock::now();
  for (SpreadSearch& search : d.searches) BROADSIDE_TRY(search.search());
  d.time.search_s = seconds_since(at);
  return core::Done{};
}

core::Status SpreadFinder::hand_on(const Consumer& take) {
  const DeviceScope scope;
  return impl_->for_each_chunk([&take](const FoundPairs& chunk) -> core::Status {
    auto device = current_device();
    if (!device.ok()) return device.error();
    return take({chunk.data, chunk.count, device.value()});
  });
}

core::Result<core::PairSet> SpreadFinder::read_back() {
  Impl& d = *impl_;
  const DeviceScope scope;
  core::PairSet set;
  if (d.is_chunked()) {
    BROADSIDE_TRY(d.for_each_chunk([&set](const FoundPairs& chunk) -> core::Status {
      const std::size_t before = set.pairs.size();
      set.pairs.resize(before + chunk.count);
      if (chunk.count == 0) return core::Done{};
      return copy_to_host(set.pairs.data() + before, chunk.data, chunk.count * sizeof(core::Pair));
    }));
  } else {
    for (const SpreadSearch& search : d.searches)
      for (const auto& part : search.parts) BROADSIDE_TRY(part->append_pairs(set.pairs));
  }
  if (!d.tells_callers()) {
    const DealtBoxes& dealt = d.searches[0].dealt;
    for (core::Pair& p : set.pairs) p = core::make_pair_of(dealt.given(p.i), dealt.given(p.j));
  }
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

std::vector<core::Counter> SpreadFinder::counters() const {
  std::uint64_t bytes = 0;
  impl_->each_part([&bytes](const PartSearch& part) { bytes += part.bytes(); });
  std::uint64_t guests = 0;
  for (const SpreadSearch& search : impl_->searches) guests += search.guests;
  constexpr std::uint64_t kNeeded = sizeof(core::Box) + sizeof(std::uint32_t);
  // With passes, a box is sent both as it is searched and as it was given.
  const std::uint64_t sent = impl_->plan.is_plain() ? 1 : 2;
  return {{"bytes between parts", guests * sizeof(PackedBox) * sent},
          {"bytes that borders need", guests * kNeeded},
          {"device bytes", bytes}};
}

std::string SpreadFinder::path() const {
  const Impl& d = *impl_;
  std::string words =
      std::to_string(d.searches.empty() ? 0 : d.cut.parts()) + " parts on " + std::to_string(d.devices) + " devices";
  if (!d.plan.is_plain()) words += ", each in passes: " + core::words_of(d.plan);
  if (d.is_chunked()) words += ", " + std::to_string(d.options.pairs_at_once) + " pairs at once";
  return words;
}

SpreadTime SpreadFinder::time() const {
  return impl_->time;
}

FindTime SpreadFinder::slowest_steps() const {
  FindTime slowest;
  impl_->each_part([&slowest](const PartSearch& part) {
    if (!part.has_searched()) return;
    FindTime own;
    own.add_steps(part.outcome());
    if (own.steps_s() >= slowest.steps_s()) slowest = own;
  });
  return slowest;
}

std::uint64_t SpreadFinder::pair_count() const {
  if (impl_->is_chunked()) return impl_->chunked_pairs;
  std::uint64_t count = 0;
  impl_->each_part([&count](const PartSearch& part) { count += part.found().count; });
  return count;
}

const core::PassPlan& SpreadFinder::plan() const {
  return impl_->plan;
}

core::Result<std::uint64_t> SpreadFinder::digest() {
  if (impl_->is_chunked())
    return core::Error{"pairs are handed on in chunks, so no list of all of them exists",
                       "a set that is spread over devices", "take them by hand_on, or leave out pairs_at_once"};
  const DeviceScope scope;
  std::uint64_t sum = 0;
  for (const SpreadSearch& search : impl_->searches) {
    for (const auto& part : search.parts) {
      auto own = part->digest();
      if (!own.ok()) return own.error();
      sum += own.value();
    }
  }
  return sum;
}

}  // namespace broadside::gpu
