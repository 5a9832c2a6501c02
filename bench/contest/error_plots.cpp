// Error against cost: one picture a scene, one line an engine, one mark a step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/contest/contest_document.hpp"
#include "reports/plots/line_plot.hpp"

namespace broadside::bench::contest {
namespace {

using reports::plots::Curve;
using reports::plots::LinePlot;
using reports::plots::Placement;
using reports::plots::Scale;

// By rising cost. Points without an error or a time are left out.
Curve curve_of(const ContestTable& table, const std::string& label, const std::map<std::string, Entry>& steps) {
  std::vector<const Entry*> points;
  for (const auto& [step, entry] : steps)
    if (std::isfinite(entry.error) && std::isfinite(entry.cost) && entry.error > 0.0 && entry.cost > 0.0)
      points.push_back(&entry);
  std::sort(points.begin(), points.end(), [](const Entry* a, const Entry* b) { return a->cost < b->cost; });
  Curve curve;
  curve.name = label;
  curve.is_hollow = !is_native(table, label);
  if (curve.is_hollow) curve.name += " (Node)";
  for (const Entry* entry : points) {
    curve.x.push_back(entry->cost);
    curve.y.push_back(entry->error);
  }
  return curve;
}

}  // namespace

bool is_native(const ContestTable& table, const std::string& label) {
  const auto build = table.builds.find(label);
  return build == table.builds.end() || build->second.find("node ") == std::string::npos;
}

void add_error_against_cost(Document& document, const ContestTable& table) {
  std::vector<Block> figures;
  // Where every engine ran at one step only, its line is a single mark. Such plots go into a fold.
  Fold marks{"", "error_marks", false, {}};
  for (const SceneTable& scene : table.scenes) {
    LinePlot plot;
    bool has_line = false;
    std::string unit;
    std::string words;
    for (const Entrant& e : table.entrants) {
      const auto of = scene.entries.find(e.engine);
      if (of == scene.entries.end()) continue;
      Curve curve = curve_of(table, e.engine, of->second);
      if (curve.x.empty()) continue;
      for (const auto& [step, entry] : of->second)
        if (!entry.error_unit.empty()) unit = entry.error_unit;
      words += fmt::format("{}: error {:.3g} {} at {:.3g} s per simulated second. ", e.engine, curve.y.back(), unit,
                           curve.x.back());
      has_line = has_line || curve.x.size() > 1;
      plot.curves.push_back(std::move(curve));
    }
    if (plot.curves.empty()) continue;
    plot.text = {scene.scene, words, "cost, seconds of computing per simulated second", "largest error, " + unit};
    plot.x_scale = plot.y_scale = Scale::kLog;
    plot.y_from_zero = false;
    auto& to = has_line ? figures : marks.blocks;
    to.emplace_back(Figure{file_name_of("error", scene.scene), svg(plot, Placement::kFile),
                           svg(plot, Placement::kInline),
                           scene.scene + ": further down is more exact, further left is cheaper."});
  }
  if (figures.empty() && marks.blocks.empty()) return;
  document.blocks.emplace_back(Heading{"Error against cost", "error"});
  document.blocks.emplace_back(Paragraph{
      "Each mark is an engine at one step size, on a scene whose answer is known in closed form: the error that is "
      "largest relative to its limit, and the cost of the engine's steps. Marks of engines under Node are hollow: "
      "their verdicts count, but their speeds do not, because WebAssembly is not the library's native code. A mark is "
      "shown even where a law is broken; the table of verdicts says which laws are." +
      (table.cells_at_once > 1
           ? fmt::format(" The machine ran {} cells at a time, so these are times of a busy machine.",
                         table.cells_at_once)
           : std::string())});
  for (Block& figure : figures) document.blocks.push_back(std::move(figure));
  if (marks.blocks.empty()) return;
  marks.summary = fmt::format("{} scenes that ran at their own step only", marks.blocks.size());
  document.blocks.emplace_back(std::move(marks));
}

}  // namespace broadside::bench::contest
