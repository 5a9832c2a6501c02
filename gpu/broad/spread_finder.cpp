#include "gpu/broad/spread_finder.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "gpu/broad/dealt_boxes.hpp"
#include "gpu/broad/part_search.hpp"

namespace broadside::gpu {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point& from) {
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - from).count();
  from = now;
  return seconds;
}

}  // namespace

struct SpreadFinder::Impl {
  SpreadOptions options;
  std::vector<std::uint8_t> is_static;
  core::SpaceCut cut;
  DealtBoxes dealt;
  std::vector<std::unique_ptr<PartSearch>> parts;
  std::uint32_t devices = 0;
  float cell_scale = 1.0F;  // of the boxes that were loaded
  SpreadTime time;
  std::uint64_t guests = 0;  // since load

  core::Status deal(std::span<const core::Box> boxes, bool is_new);
  core::Status find_borders();
  core::Status exchange();
  core::Status search();
};

SpreadFinder::SpreadFinder(const SpreadOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
SpreadFinder::~SpreadFinder() = default;

core::Status SpreadFinder::Impl::deal(std::span<const core::Box> boxes, bool is_new) {
  BROADSIDE_TRY(dealt.take(boxes, is_static, cut));
  if (is_new) cell_scale = dealt.fitted_cell_scale(boxes);
  dealt.set_cell_scale(cell_scale);
  for (std::uint32_t k = 0; k < dealt.parts(); ++k) {
    BROADSIDE_TRY(check_box_limit(dealt.facts(k).count));
    BROADSIDE_TRY(parts[k]->load(dealt.boxes(k), dealt.facts(k), dealt.base(k), cut));
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
  d.guests = 0;
  d.parts.clear();
  for (std::uint32_t k = 0; k < cut.parts(); ++k)
    d.parts.push_back(std::make_unique<PartSearch>(static_cast<int>(k % d.devices), k));
  return d.deal(boxes, true);
}

core::Status SpreadFinder::update(std::span<const core::Box> boxes) {
  Impl& d = *impl_;
  if (boxes.size() != d.is_static.size()) return another_count(boxes.size(), d.is_static.size());
  const DeviceScope scope;
  return d.deal(boxes, false);
}

core::Status SpreadFinder::Impl::find_borders() {
  for (auto& part : parts) BROADSIDE_TRY(part->start_borders());
  for (auto& part : parts) {
    for (;;) {
      auto is_done = part->finish_borders();
      if (!is_done.ok()) return is_done.error();
      if (is_done.value()) break;
      BROADSIDE_TRY(part->start_borders());
    }
  }
  return core::Done{};
}

core::Status SpreadFinder::Impl::exchange() {
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

core::Status SpreadFinder::Impl::search() {
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

core::Status SpreadFinder::find() {
  Impl& d = *impl_;
  const DeviceScope scope;
  auto at = Clock::now();
  BROADSIDE_TRY(d.find_borders());
  d.time.borders_s = seconds_since(at);
  BROADSIDE_TRY(d.exchange());
  d.time.exchange_s = seconds_since(at);
  BROADSIDE_TRY(d.search());
  d.time.search_s = seconds_since(at);
  return core::Done{};
}

core::Result<core::PairSet> SpreadFinder::read_back() {
  const DeviceScope scope;
  core::PairSet set;
  for (const auto& part : impl_->parts) BROADSIDE_TRY(part->append_pairs(set.pairs));
  for (core::Pair& p : set.pairs) p = core::make_pair_of(impl_->dealt.given(p.i), impl_->dealt.given(p.j));
  std::sort(set.pairs.begin(), set.pairs.end());
  set.demanded = set.raw = set.pairs.size();
  return set;
}

std::vector<core::Counter> SpreadFinder::counters() const {
  std::uint64_t bytes = 0;
  for (const auto& part : impl_->parts) bytes += part->bytes();
  constexpr std::uint64_t kNeeded = sizeof(core::Box) + sizeof(std::uint32_t);
  return {{"bytes between parts", impl_->guests * sizeof(PackedBox)},
          {"bytes that borders need", impl_->guests * kNeeded},
          {"device bytes", bytes}};
}

std::string SpreadFinder::path() const {
  return std::to_string(impl_->parts.size()) + " parts on " + std::to_string(impl_->devices) + " devices";
}

SpreadTime SpreadFinder::time() const {
  return impl_->time;
}

FindTime SpreadFinder::slowest_steps() const {
  FindTime slowest;
  for (const auto& part : impl_->parts) {
    if (!part->has_searched()) continue;
    FindTime own;
    own.add_steps(part->outcome());
    if (own.steps_s() >= slowest.steps_s()) slowest = own;
  }
  return slowest;
}

std::uint64_t SpreadFinder::pair_count() const {
  std::uint64_t count = 0;
  for (const auto& part : impl_->parts) count += part->found().count;
  return count;
}

core::Result<std::uint64_t> SpreadFinder::digest() {
  const DeviceScope scope;
  std::uint64_t sum = 0;
  for (const auto& part : impl_->parts) {
    auto own = part->digest();
    if (!own.ok()) return own.error();
    sum += own.value();
  }
  return sum;
}

}  // namespace broadside::gpu
