// A fold for each family of scenes: which engine breaks which law there, and every broken law with its worked line.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"
#include "bench/contest/known_causes.hpp"

namespace broadside::bench::contest {
namespace {

// The results of an engine on the scenes of a family.
struct Tally {
  std::size_t holds = 0;
  std::size_t breaks = 0;
  std::size_t absent = 0;
  std::map<std::string, std::size_t> laws;  // broken, and on how many scenes
  std::vector<std::string> causes;
  const core::Verdict* worst = nullptr;
  const SceneTable* worst_scene = nullptr;
};

void add_cause(Tally& tally, std::string_view known) {
  const std::string cause(known.empty() ? "not yet looked into" : known);
  if (std::find(tally.causes.begin(), tally.causes.end(), cause) == tally.causes.end()) tally.causes.push_back(cause);
}

Tally tally_of(const Family& family, const std::string& engine) {
  Tally tally;
  for (const SceneTable* scene : family.scenes) {
    const Entry* entry = own_entry(*scene, engine);
    if (entry == nullptr || entry->state != core::CellState::kRecorded || entry->coverage.applied() == 0) {
      ++tally.absent;
      continue;
    }
    ++(entry->broken.empty() ? tally.holds : tally.breaks);
    for (const core::Verdict& v : entry->broken) {
      ++tally.laws[v.validator];
      add_cause(tally, known_cause(engine, v.validator, scene->scene));
    }
    if (const core::Verdict* worst = worst_of(*entry);
        worst != nullptr && (tally.worst == nullptr || share_of_limit(*worst) > share_of_limit(*tally.worst))) {
      tally.worst = worst;
      tally.worst_scene = scene;
    }
  }
  return tally;
}

std::string laws_text(const Tally& tally) {
  std::string text;
  for (const auto& [law, count] : tally.laws) {
    text += (text.empty() ? "" : ", ") + law;
    if (count > 1) text += fmt::format(" {}", count);
  }
  return text;
}

TableCell words(std::string text) {
  TableCell cell{std::move(text)};
  cell.is_words = true;
  return cell;
}

std::vector<TableCell> line_of(const std::string& engine, const Tally& tally) {
  std::string laws = laws_text(tally);
  if (tally.absent > 0) laws += fmt::format("{}no trace {}", laws.empty() ? "" : ", ", tally.absent);
  TableCell broken = words(laws);
  broken.tone = tally.laws.empty() ? Tone::kAbsent : Tone::kBad;
  const std::string worst = tally.worst == nullptr
                                ? std::string()
                                : short_name(tally.worst_scene->scene) + ": " + measured_text(*tally.worst);
  return {{engine},
          {fmt::format("{} of {}", tally.holds, tally.holds + tally.breaks + tally.absent)},
          std::move(broken),
          words(worst),
          words(fmt::format("{}", fmt::join(tally.causes, "; ")))};
}

// Every broken law of the family, each with the anchor that its square links to.
Notes worked_lines(const Family& family, const ContestTable& table) {
  Notes notes;
  for (const SceneTable* scene : family.scenes)
    for (const Entrant& e : table.entrants) {
      const Entry* entry = own_entry(*scene, e.engine);
      if (entry == nullptr) continue;
      for (const core::Verdict& v : entry->broken) {
        const std::string_view cause = known_cause(e.engine, v.validator, scene->scene);
        notes.items.push_back(fmt::format("{}, {}, {}: {}: {}", scene->scene, e.engine, v.validator,
                                          cause.empty() ? "not yet looked into" : cause, v.explanation));
        // A square links to the first law that its cell broke.
        notes.ids.push_back(&v == entry->broken.data() ? broken_anchor(scene->scene, e.engine) : std::string());
      }
    }
  return notes;
}

Fold fold_of(const Family& family, const ContestTable& table) {
  Table broken{file_name_of("family", family.name),
               fmt::format("{}: engines that break a law, or have no trace", family.name),
               {"engine", "holds", "broken laws", "furthest from its limit", "why"},
               {}};
  Tally all;
  std::vector<std::string> right;
  for (const Entrant& e : table.entrants) {
    const Tally tally = tally_of(family, e.engine);
    all.holds += tally.holds;
    all.breaks += tally.breaks;
    all.absent += tally.absent;
    if (tally.breaks + tally.absent == 0)
      right.push_back(e.engine);
    else
      broken.rows.push_back(line_of(e.engine, tally));
  }
  Fold fold;
  fold.id = family_anchor(family);
  fold.is_printed = true;
  fold.summary =
      fmt::format("{}: {} scene{}; every law holds in {} cells, a law is broken in {}, no trace in {}", family.name,
                  family.scenes.size(), family.scenes.size() == 1 ? "" : "s", all.holds, all.breaks, all.absent);
  if (!right.empty()) fold.blocks.emplace_back(Paragraph{fmt::format("Every law holds: {}.", fmt::join(right, ", "))});
  if (!broken.rows.empty()) fold.blocks.emplace_back(std::move(broken));
  Notes lines = worked_lines(family, table);
  if (!lines.items.empty()) {
    Fold inner;
    inner.id = fold.id + "_lines";
    inner.summary = fmt::format("{} broken laws, each with its figures", lines.items.size());
    inner.blocks.emplace_back(std::move(lines));
    fold.blocks.emplace_back(std::move(inner));
  }
  return fold;
}

}  // namespace

void add_families(Document& document, const ContestTable& table) {
  if (table.scenes.empty()) return;
  document.blocks.emplace_back(Heading{"Scene by scene", "families"});
  document.blocks.emplace_back(Paragraph{
      "Each line is a family of scenes; click on it to open it. \"friction-cone 4\": the law friction-cone is broken "
      "on four of its scenes."});
  for (const Family& family : families_of(table)) document.blocks.emplace_back(fold_of(family, table));
}

}  // namespace broadside::bench::contest
