#include "validation/subject_facts.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace broadside::validation {
namespace {

// "a=1,b=2" as keys and values.
std::vector<std::pair<std::string_view, std::string_view>> items(const core::Stamp& stamp) {
  std::vector<std::pair<std::string_view, std::string_view>> out;
  std::string_view rest = stamp.settings;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    const std::size_t equals = item.find('=');
    if (equals != std::string_view::npos) out.emplace_back(item.substr(0, equals), item.substr(equals + 1));
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return out;
}

}  // namespace

bool has(const core::TraceHeader& header, core::Group group) {
  return (header.groups & core::bit(group)) != 0;
}

double correction_rate(const core::TraceHeader& header) {
  return header.declaration.text("correction") == "none" ? 0.0 : header.declaration.number("correction_rate");
}

bool has_impulses(const core::TraceHeader& header) {
  return has(header, core::Group::kPoints) && header.declaration.text("contacts") != "geometry";
}

std::string lacking_impulses(const core::TraceHeader& header) {
  std::string text = lacking(header, core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints));
  if (text.empty() && !has_impulses(header)) text = "the engine declares points without impulses (contacts = geometry)";
  return text;
}

std::string lacking(const core::TraceHeader& header, std::uint32_t groups) {
  static constexpr std::array<std::pair<core::Group, std::string_view>, 11> kWords{{
      {core::Group::kBodies, "end-of-frame states"},
      {core::Group::kDetection, "boxes"},
      {core::Group::kPairs, "candidate pairs"},
      {core::Group::kConfirmed, "confirmed pairs"},
      {core::Group::kContacts, "contacts"},
      {core::Group::kNarrow, "measured separations"},
      {core::Group::kOctree, "scene octree"},
      {core::Group::kBodyOctree, "body octrees"},
      {core::Group::kDetectedOrientation, "orientations at detection"},
      {core::Group::kPoints, "points of contact"},
      {core::Group::kPartPoses, "poses between the parts of a step"},
  }};
  for (const auto& [group, word] : kWords)
    if ((groups & core::bit(group)) != 0 && !has(header, group)) return "the trace records no " + std::string(word);
  return {};
}

std::string_view setting(const core::Stamp& stamp, std::string_view key) {
  for (const auto& [name, value] : items(stamp))
    if (name == key) return value;
  return {};
}

bool same_settings_but(const core::Stamp& a, const core::Stamp& b, std::initializer_list<std::string_view> but) {
  const auto agrees = [&](const core::Stamp& from, const core::Stamp& with) {
    for (const auto& [key, value] : items(from)) {
      if (std::find(but.begin(), but.end(), key) != but.end()) continue;
      const std::string_view other = setting(with, key);
      if (other != value && !(other.empty() && a.engine != b.engine)) return false;
    }
    return true;
  };
  return agrees(a, b) && agrees(b, a);
}

bool moves_bodies(const core::TraceHeader& header) {
  return header.driver.empty() && (header.groups == 0 || has(header, core::Group::kBodies));
}

bool are_twins(const core::TraceHeader& a, const core::TraceHeader& b) {
  const auto origin = [](const core::TraceHeader& h) {
    return h.declaration.declares("twin_of") ? h.declaration.text("twin_of") : std::string_view(h.stamp.engine);
  };
  return origin(a) == origin(b);
}

std::string why_not_method(const core::TraceHeader& header) {
  if (header.declaration.follows_method()) return {};
  return "the engine does not declare the method of METHOD (" + std::string(core::kMethodName) + ")";
}

}  // namespace broadside::validation
