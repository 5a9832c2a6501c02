// Which engine is right, on one screen: one line per engine, one square per scene.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"
#include "bench/contest/known_causes.hpp"

namespace broadside::bench::contest {
namespace {

constexpr std::string_view kUnknown = "?";
constexpr std::string_view kAbsent = "\u2013";
// The largest count that a square has room for.
constexpr std::size_t kMostCounted = 9;

bool has_every_cause(const Entry& entry, const std::string& engine, const std::string& scene) {
  return std::none_of(entry.broken.begin(), entry.broken.end(),
                      [&](const core::Verdict& v) { return known_cause(engine, v.validator, scene).empty(); });
}

Square square_of(const SceneTable& scene, const Entrant& e) {
  const Entry* entry = own_entry(scene, e.engine);
  Square square;
  const std::string at = short_name(scene.scene) + ", " + e.engine + ": ";
  if (entry == nullptr || entry->state != core::CellState::kRecorded || entry->coverage.applied() == 0) {
    square.tone = Tone::kAbsent;
    square.mark = kAbsent;
    square.words = at + (entry != nullptr ? entry_text(*entry) : e.absent.empty() ? "not run" : "absent: " + e.absent);
    return square;
  }
  square.words = at + entry_text(*entry);
  if (entry->broken.empty()) {
    square.tone = Tone::kGood;
    if (entry->has_nearest) square.words += "; nearest to its limit is " + measured_text(entry->nearest);
    return square;
  }
  square.tone = Tone::kBad;
  square.is_open = !has_every_cause(*entry, e.engine, scene.scene);
  square.mark = square.is_open ? std::string(kUnknown) : std::to_string(std::min(entry->broken.size(), kMostCounted));
  square.words += "; furthest from its limit is " + measured_text(*worst_of(*entry));
  if (square.is_open) square.words += "; not yet looked into";
  square.target = broken_anchor(scene.scene, e.engine);
  return square;
}

}  // namespace

void add_overview(Document& document, const ContestTable& table) {
  Mosaic mosaic;
  mosaic.caption = "Laws of mechanics at the scenes' own steps, by engine and scene";
  for (const Entrant& e : table.entrants) mosaic.rows.push_back({e.engine, {}});
  for (const Family& family : families_of(table))
    for (const SceneTable* scene : family.scenes) {
      mosaic.columns.push_back({short_name(scene->scene), family_anchor(family), scene == family.scenes.front()});
      for (std::size_t k = 0; k < table.entrants.size(); ++k)
        mosaic.rows[k].squares.push_back(square_of(*scene, table.entrants[k]));
    }
  if (mosaic.columns.empty()) return;
  mosaic.legend = {{Tone::kGood, false, "", "every law holds", ""},
                   {Tone::kBad, false, "2", "this many laws are broken; the causes are known", ""},
                   {Tone::kBad, true, std::string(kUnknown), "broken; not yet looked into", ""},
                   {Tone::kAbsent, false, std::string(kAbsent), "no trace, or nothing judged", ""}};
  document.blocks.emplace_back(Heading{"Which engine is right", "overview"});
  document.blocks.emplace_back(
      Paragraph{"Hover over a square for details; a red square links to the figures of its broken laws."});
  document.blocks.emplace_back(std::move(mosaic));
}

}  // namespace broadside::bench::contest
