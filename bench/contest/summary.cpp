// The page in a few sentences: which engine is right where, which is cheap there, and what stands at the step that
// games take.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"

namespace broadside::bench::contest {
namespace {

constexpr double kGamesStep_s = 1.0 / 60.0;
constexpr std::size_t kMostNamed = 6;

bool was_judged(const Entry* entry) {
  return entry != nullptr && entry->state == core::CellState::kRecorded && entry->coverage.applied() > 0;
}

bool holds(const Entry* entry) {
  return was_judged(entry) && entry->broken.empty();
}

std::string library_of(const std::string& label) {
  return label.substr(0, label.find('['));
}

// "a 5, b 3 and 2 others less": the largest first, those of equal counts in the order of their names.
std::string by_count(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (std::size_t k = 0; k < std::min(sorted.size(), kMostNamed); ++k)
    text += fmt::format("{}{} {}", k == 0 ? "" : ", ", sorted[k].first, sorted[k].second);
  if (sorted.size() > kMostNamed) text += fmt::format(", the other {} as many or fewer", sorted.size() - kMostNamed);
  return text;
}

// Each engine with the setting that is right on most scenes.
std::string who_is_right(const ContestTable& table) {
  std::map<std::string, std::pair<std::string, std::size_t>> best;
  for (const Entrant& e : table.entrants) {
    std::size_t count = 0;
    for (const SceneTable& scene : table.scenes) count += holds(own_entry(scene, e.engine)) ? 1 : 0;
    auto& of_it = best[library_of(e.engine)];
    if (of_it.first.empty() || count > of_it.second) of_it = {e.engine, count};
  }
  std::map<std::string, std::size_t> counts;
  for (const auto& [library, setting] : best) counts[setting.first] = setting.second;
  return fmt::format("Scenes, of {}, on which every law holds, with each engine's best setting: {}.",
                     table.scenes.size(), by_count(counts));
}

// Scenes on which no engine is wrong, and the one on which most are.
std::string where_all_are_right(const ContestTable& table) {
  std::vector<std::string> right;
  std::string hardest;
  std::size_t most = 0;
  std::size_t of = 0;
  for (const SceneTable& scene : table.scenes) {
    std::size_t judged = 0;
    std::size_t wrong = 0;
    for (const Entrant& e : table.entrants) {
      const Entry* entry = own_entry(scene, e.engine);
      judged += was_judged(entry) ? 1 : 0;
      wrong += was_judged(entry) && !entry->broken.empty() ? 1 : 0;
    }
    if (judged > 0 && wrong == 0) right.push_back(short_name(scene.scene));
    if (wrong > most) most = wrong, of = judged, hardest = short_name(scene.scene);
  }
  std::string text = right.empty() ? std::string("On every scene an engine breaks a law")
                                   : fmt::format("No engine breaks a law on {}", fmt::join(right, ", "));
  if (most > 0) text += fmt::format("; a law is broken most often on {}: in {} of {} rows", hardest, most, of);
  return text + ".";
}

// Times of WebAssembly do not count.
std::string who_is_cheap(const ContestTable& table) {
  std::map<std::string, std::size_t> counts;
  std::size_t scenes = 0;
  for (const SceneTable& scene : table.scenes) {
    const Entrant* cheapest = nullptr;
    double least = INFINITY;
    for (const Entrant& e : table.entrants) {
      const Entry* entry = own_entry(scene, e.engine);
      if (!holds(entry) || !is_native(table, e.engine) || !(entry->cost < least)) continue;
      least = entry->cost;
      cheapest = &e;
    }
    if (cheapest == nullptr) continue;
    ++scenes;
    ++counts[library_of(cheapest->engine)];
  }
  if (scenes == 0) return {};
  return fmt::format("Scenes, of {}, on which a native engine is the cheapest of those that break no law: {}{}.",
                     scenes, by_count(counts),
                     table.cells_at_once > 1 ? " (the machine ran several cells at a time)" : "");
}

std::string what_stands(const ContestTable& table) {
  std::map<std::string, std::size_t> counts;
  std::size_t scenes = 0;
  for (const SceneTable& scene : table.scenes) {
    bool is_one = false;
    std::map<std::string, bool> stands;  // by engine: with any of its settings
    for (const Entrant& e : table.entrants) {
      const auto of = scene.entries.find(e.engine);
      if (of == scene.entries.end()) continue;
      for (const auto& [step, entry] : of->second) {
        if (!entry.has_rest || std::abs(entry.dt_s - kGamesStep_s) > 1e-6) continue;
        is_one = true;
        stands[library_of(e.engine)] |= entry.stands;
      }
    }
    scenes += is_one ? 1 : 0;
    for (const auto& [library, does] : stands) counts[library] += does ? 1 : 0;
  }
  if (scenes == 0) return {};
  return fmt::format(
      "Scenes, of {} that stand by statics, that stand at 1/60 s with at least one of the engine's settings: {}.",
      scenes, by_count(counts));
}

std::string who_repeats(const ContestTable& table) {
  std::size_t timed = 0;
  std::size_t same = 0;
  for (const SceneTable& scene : table.scenes)
    for (const auto& [label, steps] : scene.entries)
      for (const auto& [step, entry] : steps) {
        timed += entry.was_timed ? 1 : 0;
        same += entry.was_timed && entry.repeats ? 1 : 0;
      }
  if (timed == 0) return {};
  return fmt::format("{} of {} timed runs ended in the same bits as the recorded run.", same, timed);
}

}  // namespace

void add_summary(Document& document, const ContestTable& table) {
  Notes sentences;
  if (table.scenes.empty()) return;
  for (std::string sentence :
       {who_is_right(table), where_all_are_right(table), who_is_cheap(table), what_stands(table), who_repeats(table)})
    if (!sentence.empty()) sentences.items.push_back(std::move(sentence));
  document.blocks.emplace_back(std::move(sentences));
}

}  // namespace broadside::bench::contest
