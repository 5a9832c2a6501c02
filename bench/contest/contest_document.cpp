#include "bench/contest/contest_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>

#include "bench/contest/families.hpp"
#include "bench/contest/tunings.hpp"

namespace broadside::bench::contest {
namespace {

struct Count {
  std::size_t holds = 0;
  std::size_t breaks = 0;
  std::size_t absent = 0;
};

// Counts cells at the scenes' own steps.
Count count_of(const ContestTable& table) {
  Count count;
  for (const SceneTable& scene : table.scenes)
    for (const auto& [label, steps] : scene.entries) {
      const auto own = steps.find("");
      if (own == steps.end()) continue;
      const Entry& entry = own->second;
      if (entry.state != core::CellState::kRecorded)
        ++count.absent;
      else
        ++(entry.broken.empty() ? count.holds : count.breaks);
    }
  return count;
}

Tone tone_of(const Entry* entry) {
  if (entry == nullptr || entry->state != core::CellState::kRecorded || entry->coverage.applied() == 0)
    return Tone::kAbsent;
  return entry->broken.empty() ? Tone::kGood : Tone::kBad;
}

}  // namespace

std::vector<std::string> columns_of(const ContestTable& table, std::vector<std::string> first) {
  for (const Entrant& e : table.entrants) first.push_back(e.engine);
  return first;
}

std::string file_name_of(const std::string& what, std::string scene) {
  std::replace_if(
      scene.begin(), scene.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return what + "_" + scene;
}

void add_verdicts(Document& document, const ContestTable& table) {
  if (table.scenes.empty()) return;
  Fold fold{"The same in words: every cell, and how many laws could be judged there", "verdicts", false, {}};
  fold.blocks.emplace_back(Paragraph{
      "Each scene at its own step. \"holds, 9 of 14\": 9 of the 14 laws of mechanics found something to judge in the "
      "trace, and all 9 hold. Where an engine has no trace, the cell says why."});
  Table verdicts{"verdicts", "Laws of mechanics, by scene and engine", columns_of(table, {"scene"}), {}};
  for (const SceneTable& scene : table.scenes) {
    std::vector<TableCell> line{{scene.scene}};
    for (const Entrant& e : table.entrants) {
      const Entry* entry = own_entry(scene, e.engine);
      TableCell cell{entry != nullptr ? entry_text(*entry) : e.absent.empty() ? "not run" : "absent: " + e.absent};
      cell.tone = tone_of(entry);
      line.push_back(std::move(cell));
    }
    verdicts.rows.push_back(std::move(line));
  }
  fold.blocks.emplace_back(std::move(verdicts));
  document.blocks.emplace_back(std::move(fold));
}

void add_stability(Document& document, const ContestTable& table) {
  Table stands{"stands", "The longest step at which the scene stands, s", columns_of(table, {"scene"}), {}};
  for (const SceneTable& scene : table.scenes) {
    std::vector<TableCell> line{{scene.scene}};
    bool has_rest = false;
    for (const Entrant& e : table.entrants) {
      double longest = 0.0;
      bool was_judged = false;
      if (const auto of = scene.entries.find(e.engine); of != scene.entries.end())
        for (const auto& [step, entry] : of->second) {
          was_judged = was_judged || entry.has_rest;
          if (entry.has_rest && entry.stands) longest = std::max(longest, entry.dt_s);
        }
      has_rest = has_rest || was_judged;
      if (!was_judged)
        line.push_back({"not judged"});
      else if (longest > 0.0)
        line.push_back({"1/" + fmt::format("{:.4g}", 1.0 / longest), longest});
      else
        line.push_back({"at none"});
    }
    if (has_rest) stands.rows.push_back(std::move(line));
  }
  if (stands.rows.empty()) return;
  document.blocks.emplace_back(Heading{"What stands, and at which step", "stands"});
  document.blocks.emplace_back(Paragraph{
      "The longest of the steps that ran: each scene's own step, 1/60 s where that is longer, and for some scenes "
      "fractions and multiples of their own step. The table of verdicts shows the scenes' own steps only."});
  document.blocks.emplace_back(
      Fold{"The longest steps, by scene and engine", "stands_table", false, {std::move(stands)}});
}

namespace {

// Over the scenes on which an engine ran with several numbers of threads.
std::string threads_text(const ContestTable& table, const Entrant& e) {
  std::size_t scenes = 0;
  std::size_t alike = 0;
  for (const SceneTable& scene : table.scenes)
    if (const auto of = scene.thread_digests.find(e.engine); of != scene.thread_digests.end()) {
      ++scenes;
      alike += of->second.size() == 1 ? 1 : 0;
    }
  return scenes == 0 ? "one thread only" : fmt::format("same digest on {} of {} scenes", alike, scenes);
}

}  // namespace

void add_determinism(Document& document, const ContestTable& table) {
  Table repeats{"repeats",
                "Digests of the timed and the recorded run, and of runs on one and two threads",
                {"engine", "cells", "same digest", "other digest", "one and two threads"},
                {}};
  for (const Entrant& e : table.entrants) {
    std::size_t cells = 0;
    std::size_t same = 0;
    for (const SceneTable& scene : table.scenes)
      if (const auto of = scene.entries.find(e.engine); of != scene.entries.end())
        for (const auto& [step, entry] : of->second) {
          cells += entry.was_timed ? 1 : 0;
          same += entry.was_timed && entry.repeats ? 1 : 0;
        }
    if (cells > 0)
      repeats.rows.push_back({{e.engine},
                              {std::to_string(cells)},
                              {std::to_string(same)},
                              {std::to_string(cells - same)},
                              {threads_text(table, e)}});
  }
  if (repeats.rows.empty()) return;
  document.blocks.emplace_back(Heading{"The same bits twice", "repeats"});
  document.blocks.emplace_back(Paragraph{
      "Recording and timing run the same work twice on this machine. Both runs of a deterministic engine end in the "
      "same digest. If an engine's number of threads can be set, runs on one and on two threads must end in the same "
      "digest too. The other engines run on one thread here."});
  document.blocks.emplace_back(Fold{"Repeats, by engine", "repeats_table", false, {std::move(repeats)}});
}

void add_tunings(Document& document, const ContestTable& table) {
  Table rows{"tunings",
             "Engines as shipped, and as their manuals recommend",
             {"as its library ships", "as recommended", "what is", "source"},
             {}};
  const auto is_here = [&](std::string_view label) {
    return std::any_of(table.entrants.begin(), table.entrants.end(),
                       [label](const Entrant& e) { return e.engine == label; });
  };
  for (const Tuning& t : tunings())
    if (is_here(t.as_shipped) || is_here(t.recommended))
      rows.rows.push_back({{std::string(t.as_shipped)},
                           {t.recommended.empty() ? "the same" : std::string(t.recommended)},
                           {std::string(t.what)},
                           {std::string(t.source)}});
  if (rows.rows.empty()) return;
  document.blocks.emplace_back(Heading{"Tunings", "tunings"});
  document.blocks.emplace_back(Paragraph{
      "The settings that an engine ships with, and those that its manual recommends; the same for all scenes. Where a "
      "manual says \"more\" without a number, the number is ours."});
  document.blocks.emplace_back(Fold{"Tunings, by engine", "tunings_table", false, {std::move(rows)}});
}

void add_declarations(Document& document, const ContestTable& table) {
  std::set<std::string> keys;
  for (const auto& [label, declared] : table.declarations)
    for (const auto& [key, text] : declared) keys.insert(key);
  if (keys.empty()) return;
  document.blocks.emplace_back(Heading{"What each engine declares", "declarations"});
  document.blocks.emplace_back(Paragraph{
      "Laws are chosen and limits are set by what an engine declares, never by its name. A property that an engine "
      "does not declare has the value that the plainest correct engine would declare."});
  Table declared{"declarations", "Declarations side by side", {"engine", "library"}, {}};
  declared.columns.insert(declared.columns.end(), keys.begin(), keys.end());
  for (const Entrant& e : table.entrants) {
    const auto of = table.declarations.find(e.engine);
    const auto build = table.builds.find(e.engine);
    if (of == table.declarations.end()) continue;
    std::vector<TableCell> line{{e.engine}, {build == table.builds.end() ? "not told" : build->second}};
    for (const std::string& key : keys) {
      const auto text = of->second.find(key);
      line.push_back({text == of->second.end() ? "not declared" : text->second});
    }
    declared.rows.push_back(std::move(line));
  }
  document.blocks.emplace_back(Fold{"Declarations side by side", "declarations_table", false, {std::move(declared)}});
}

Document contest_document(const ContestTable& table, const std::string& command) {
  const Count count = count_of(table);
  std::size_t here = 0;
  for (const Entrant& e : table.entrants) here += e.absent.empty() ? 1 : 0;
  Document document;
  document.title = "Engines of rigid bodies on scenes with known answers";
  document.lead = fmt::format(
      "{} engines on {} scenes: at the scenes' own steps every law that applies holds in {} cells, a law is broken "
      "in {}, and {} have no trace.",
      here, table.scenes.size(), count.holds, count.breaks, count.absent);
  for (const Entrant& e : table.entrants)
    if (!e.absent.empty()) document.lead += fmt::format(" {} is absent ({}).", e.engine, e.absent);
  add_summary(document, table);
  add_overview(document, table);
  add_causes(document, table);
  add_families(document, table);
  add_verdicts(document, table);
  add_error_against_cost(document, table);
  add_energy_over_time(document, table);
  add_stability(document, table);
  add_other_steps(document, table);
  add_stacks(document, table);
  add_heaps(document, table);
  add_passages(document, table);
  add_determinism(document, table);
  add_tunings(document, table);
  add_declarations(document, table);
  document.blocks.emplace_back(Heading{"How to repeat", "repeat"});
  document.blocks.emplace_back(Paragraph{command});
  return document;
}

}  // namespace broadside::bench::contest
