#include "validation/subject_facts.hpp"

#include <array>
#include <utility>

namespace broadside::validation {

bool has(const core::TraceHeader& header, core::Group group) {
  return (header.groups & core::bit(group)) != 0;
}

std::string lacking(const core::TraceHeader& header, std::uint32_t groups) {
  static constexpr std::array<std::pair<core::Group, std::string_view>, 6> kWords{{
      {core::Group::kBodies, "end-of-frame states"},
      {core::Group::kDetection, "boxes"},
      {core::Group::kPairs, "candidate pairs"},
      {core::Group::kConfirmed, "confirmed pairs"},
      {core::Group::kContacts, "contacts"},
      {core::Group::kNarrow, "measured separations"},
  }};
  for (const auto& [group, word] : kWords)
    if ((groups & core::bit(group)) != 0 && !has(header, group)) return "the trace records no " + std::string(word);
  return {};
}

std::string_view setting(const core::Stamp& stamp, std::string_view key) {
  std::string_view rest = stamp.settings;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    const std::size_t equals = item.find('=');
    if (equals != std::string_view::npos && item.substr(0, equals) == key) return item.substr(equals + 1);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  return {};
}

std::string settings_that_matter(const core::Stamp& stamp) {
  std::string out;
  std::string_view rest = stamp.settings;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    if (!item.starts_with("threads=")) out += (out.empty() ? "" : ",") + std::string(item);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  return out;
}

bool are_twins(std::string_view engine, std::string_view other) {
  const auto family = [](std::string_view id) {
    return id.ends_with("-cpu") || id.ends_with("-gpu") ? id.substr(0, id.size() - 4) : id;
  };
  return family(engine) == family(other);
}

std::string why_not_method_response(const core::TraceHeader& header) {
  if (header.stamp.engine.starts_with("bullet-"))
    return "Bullet resolves contacts by its own iterated solver, not by the method's response";
  return {};
}

}  // namespace broadside::validation
