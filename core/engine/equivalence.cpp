#include "core/engine/equivalence.hpp"

#include <charconv>

namespace broadside::core {
namespace {

constexpr std::string_view kFact = "equivalence: ";
constexpr std::string_view kDiffers = " | the scene asks for: ";
constexpr std::string_view kDefect = "vendor defect: ";
constexpr std::string_view kBar = " | ";

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void add_notes(const EquivalenceCard& card, std::map<std::string, std::string>& notes) {
  for (const EquivalenceFact& fact : card)
    notes[std::string(kFact) + fact.property] =
        fact.differs() ? fact.engine + std::string(kDiffers) + fact.scene : fact.engine;
}

// "vendor defect: FCL 0.7.0 | fcl#491 | mesh distance in overlap is 0" -> "3 of 120".
void add_notes(const std::vector<DefectHits>& defects, std::map<std::string, std::string>& notes) {
  for (const DefectHits& d : defects)
    notes[std::string(kDefect) + d.library + std::string(kBar) + d.upstream + std::string(kBar) + d.predicate] =
        std::to_string(d.hits) + " of " + std::to_string(d.asked);
}

std::optional<EquivalenceFact> equivalence_of_note(std::string_view key, std::string_view text) {
  if (!key.starts_with(kFact)) return std::nullopt;
  EquivalenceFact fact;
  fact.property = key.substr(kFact.size());
  const auto bar = text.find(kDiffers);
  fact.engine = text.substr(0, bar);
  if (bar != std::string_view::npos) fact.scene = text.substr(bar + kDiffers.size());
  return fact;
}

std::optional<DefectHits> defect_of_note(std::string_view key, std::string_view text) {
  if (!key.starts_with(kDefect)) return std::nullopt;
  key.remove_prefix(kDefect.size());
  const auto first = key.find(kBar);
  const auto second = first == std::string_view::npos ? first : key.find(kBar, first + kBar.size());
  const auto of = text.find(" of ");
  if (second == std::string_view::npos || of == std::string_view::npos) return std::nullopt;
  const auto hits = number(text.substr(0, of));
  const auto asked = number(text.substr(of + 4));
  if (!hits || !asked) return std::nullopt;
  DefectHits d;
  d.library = key.substr(0, first);
  d.upstream = key.substr(first + kBar.size(), second - first - kBar.size());
  d.predicate = key.substr(second + kBar.size());
  d.hits = *hits;
  d.asked = *asked;
  return d;
}

}  // namespace broadside::core
