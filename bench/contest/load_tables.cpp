// Scenes that carry load: stacks, arches and mass ratios, and the heaps of many boxes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/contest/contest_document.hpp"

namespace broadside::bench::contest {
namespace {

std::string millimeters(double m) {
  return std::isfinite(m) ? fmt::format("{:.2g} mm deep", 1e3 * m) : std::string("depth not judged");
}

TableCell word(const Entry* entry, const Entrant& e) {
  TableCell cell{entry != nullptr ? entry_text(*entry) : e.absent.empty() ? "not run" : "absent: " + e.absent};
  cell.tone = Tone::kAbsent;
  return cell;
}

TableCell standing(const Entry* entry, const Entrant& e) {
  if (entry == nullptr || entry->state != core::CellState::kRecorded) return word(entry, e);
  if (!entry->has_rest) return {"not judged", std::nan(""), std::nan(""), false, Tone::kAbsent};
  TableCell cell{fmt::format("{}, {:.2g} {}; {}", entry->stands ? "stands" : "moves", entry->rest, entry->rest_unit,
                             millimeters(entry->deepest_m))};
  cell.tone = entry->stands ? Tone::kGood : Tone::kBad;
  return cell;
}

// A heap has no answer: what it costs, how deep bodies sink, and how many laws it breaks.
TableCell heap(const Entry* entry, const Entrant& e) {
  if (entry == nullptr || entry->state != core::CellState::kRecorded) return word(entry, e);
  const std::string cost =
      std::isfinite(entry->cost) ? fmt::format("{:.3g} ms a step", 1e3 * entry->cost * entry->dt_s) : "not timed";
  TableCell cell{cost + "; " + millimeters(entry->deepest_m)};
  cell.value = 1e3 * entry->cost * entry->dt_s;
  cell.tone = entry->broken.empty() ? Tone::kGood : Tone::kBad;
  return cell;
}

}  // namespace

void add_stacks(Document& document, const ContestTable& table) {
  Table stacks{"stacks", "What stands by statics, at the scenes' own steps", columns_of(table, {"scene"}), {}};
  for (const SceneTable& scene : table.scenes) {
    const bool is_any_judged = std::any_of(table.entrants.begin(), table.entrants.end(), [&](const Entrant& e) {
      const Entry* entry = own_entry(scene, e.engine);
      return entry != nullptr && entry->has_rest;
    });
    if (!is_any_judged) continue;
    std::vector<TableCell> line{{scene.scene}};
    for (const Entrant& e : table.entrants) line.push_back(standing(own_entry(scene, e.engine), e));
    stacks.rows.push_back(std::move(line));
  }
  if (stacks.rows.empty()) return;
  document.blocks.emplace_back(Heading{"Stacks and mass ratios", "stacks"});
  document.blocks.emplace_back(
      Paragraph{"The largest creep since a scene settled, as the law rest measures it, and the deepest overlap. In "
                "stack:1000-on-1 a body of 1000 kg stands on one of 1 kg."});
  document.blocks.emplace_back(
      Fold{"Creep and depth, by scene and engine", "stacks_table", false, {std::move(stacks)}});
}

void add_heaps(Document& document, const ContestTable& table) {
  constexpr std::string_view kHeap = "freefall:";
  Table heaps{
      "heaps", "Heaps of boxes: the median time of a step, and the deepest overlap", columns_of(table, {"scene"}), {}};
  for (const SceneTable& scene : table.scenes) {
    if (!scene.scene.starts_with(kHeap)) continue;
    std::vector<TableCell> line{{scene.scene}};
    for (const Entrant& e : table.entrants) line.push_back(heap(own_entry(scene, e.engine), e));
    heaps.rows.push_back(std::move(line));
  }
  if (heaps.rows.empty()) return;
  document.blocks.emplace_back(Heading{"Heaps", "heaps"});
  document.blocks.emplace_back(Paragraph{
      "How an engine's cost grows with the number of bodies. Red: a law is broken, so the time is no result. Engines "
      "under Node are slower than their native libraries. contest --heaps adds 10,000 boxes."});
  document.blocks.emplace_back(Fold{"Time and depth, by scene and engine", "heaps_table", false, {std::move(heaps)}});
}

}  // namespace broadside::bench::contest
