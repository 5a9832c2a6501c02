#include "bench/bisect/contact_sets.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "core/pair.hpp"
#include "core/trace/trace_reader.hpp"
#include "reports/wording.hpp"

namespace broadside::bench::bisect {
namespace {

using PairsInOrder = std::set<core::Pair>;

constexpr std::uint32_t kWhoTouches =
    core::bit(core::Group::kContacts) | core::bit(core::Group::kPoints) | core::bit(core::Group::kNarrow);

PairsInOrder touching(const core::FrameRecord& frame) {
  PairsInOrder pairs;
  for (const core::Contact& contact : frame.contacts) pairs.insert(core::make_pair_of(contact.a, contact.b));
  for (const core::ContactPoint& point : frame.points) pairs.insert(core::make_pair_of(point.a, point.b));
  for (std::size_t k = 0; k < frame.separations.size(); ++k)
    if (frame.separations[k].is_touching) pairs.insert(frame.measured[k]);
  return pairs;
}

// The lowest pair that the second set lacks.
std::string only_in(const PairsInOrder& first, const PairsInOrder& second) {
  for (const core::Pair& pair : first)
    if (!second.contains(pair)) return reports::body_name(pair.i) + " and " + reports::body_name(pair.j);
  return {};
}

}  // namespace

core::Result<std::optional<ContactSetDifference>> compare_contact_sets(const std::filesystem::path& was,
                                                                       const std::filesystem::path& is) {
  const auto before = core::TraceReader::open(was);
  if (!before) return before.error();
  const auto after = core::TraceReader::open(is);
  if (!after) return after.error();
  std::map<std::uint64_t, std::uint64_t> place;  // by step, the index of its frame in the second trace
  for (std::uint64_t k = 0; k < after.value().frame_count(); ++k) place[after.value().steps()[k]] = k;
  for (std::uint64_t k = 0; k < before.value().frame_count(); ++k) {
    const std::uint64_t step = before.value().steps()[k];
    const auto same = place.find(step);
    if (same == place.end()) continue;
    const auto a = before.value().read(k, kWhoTouches);
    if (!a) return a.error();
    const auto b = after.value().read(same->second, kWhoTouches);
    if (!b) return b.error();
    const PairsInOrder touch_before = touching(a.value());
    const PairsInOrder touch_after = touching(b.value());
    if (touch_before != touch_after)
      return std::optional(ContactSetDifference{step, touch_before.size(), touch_after.size(),
                                                only_in(touch_before, touch_after),
                                                only_in(touch_after, touch_before)});
  }
  return std::optional<ContactSetDifference>();
}

}  // namespace broadside::bench::bisect
