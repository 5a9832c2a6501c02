// Laws that are broken at other steps than a scene's own, and not at its own: the squares do not show them.
#include <fmt/format.h>

#include <algorithm>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"
#include "bench/contest/known_causes.hpp"

namespace broadside::bench::contest {
namespace {

bool breaks(const Entry* entry, const std::string& law) {
  return entry != nullptr && std::any_of(entry->broken.begin(), entry->broken.end(),
                                         [&](const core::Verdict& v) { return v.validator == law; });
}

// A line for each law that holds, or has nothing to judge, at the scene's own step.
void add_lines(Table& table, const SceneTable& scene, const std::string& engine) {
  const auto of = scene.entries.find(engine);
  if (of == scene.entries.end()) return;
  const Entry* own = own_entry(scene, engine);
  for (const auto& [step, entry] : of->second) {
    if (step.empty()) continue;
    for (const core::Verdict& v : entry.broken) {
      if (breaks(own, v.validator)) continue;
      const std::string_view cause = known_cause(engine, v.validator, scene.scene + "@" + step);
      TableCell why{cause.empty() ? "not yet looked into" : std::string(cause)};
      why.is_words = true;
      if (cause.empty()) why.tone = Tone::kBad;
      table.rows.push_back({{engine},
                            {short_name(scene.scene) + " in steps of " + step + " s"},
                            {v.validator},
                            {fmt::format("{:.3g} {}", v.measured, v.unit)},
                            {fmt::format("{:.3g} {}", v.limit, v.unit)},
                            std::move(why)});
    }
  }
}

}  // namespace

void add_other_steps(Document& document, const ContestTable& table) {
  Table broken{"other_steps",
               "Laws that hold, or have nothing to judge, at a scene's own step and are broken at another",
               {"engine", "scene", "law", "furthest from its limit", "limit", "why"},
               {}};
  for (const Entrant& e : table.entrants)
    for (const SceneTable& scene : table.scenes) add_lines(broken, scene, e.engine);
  if (broken.rows.empty()) return;
  const auto open = std::count_if(broken.rows.begin(), broken.rows.end(),
                                  [](const std::vector<TableCell>& line) { return line.back().tone == Tone::kBad; });
  const std::string title =
      fmt::format("{} laws hold at a scene's own step, and are broken at another; {} of them not yet looked into",
                  broken.rows.size(), open);
  document.blocks.emplace_back(Fold{title, "other_steps_table", false, {std::move(broken)}});
}

}  // namespace broadside::bench::contest
