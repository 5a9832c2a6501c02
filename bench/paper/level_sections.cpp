// P-Tables 5 and 6 and Figure 4: the levels of the body octree.
#include <cmath>

#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "datasets/published/published_figures.hpp"
#include "reports/plots/bar_plot.hpp"
#include "reports/plots/line_plot.hpp"

namespace broadside::bench::paper {
namespace {

using datasets::published_table;
using datasets::PublishedTable;
using reports::plots::Curve;
using reports::plots::LinePlot;
using reports::plots::Placement;
using reports::plots::Scale;

double published(std::string_view table_name, const std::string& model, std::uint32_t count,
                 const std::string& column) {
  const PublishedTable& table = published_table(table_name);
  const auto row = table.find(model, count);
  return row ? table.number(*row, column) : kNoValue;
}

// FPS against the count for one model: our curves with bands, the published ones dashed in the same color.
Figure level_figure(const RowTable& rows, const std::string& model, std::string_view table,
                    const std::vector<std::string>& methods) {
  LinePlot plot;
  plot.text = {model + ": frames per second against bodies", "", "bodies", "frames per second"};
  plot.y_scale = Scale::kLog;
  std::string words;
  for (const std::string& method : methods) {
    Curve ours{.name = method};
    Curve theirs{.name = method + ", published", .is_fitted = true};
    for (const auto& [m, count] : rows.places()) {
      if (m != model) continue;
      const Measured fps = fps_of(rows.find(model, count, method));
      const double width = std::isfinite(fps.deviation) ? fps.deviation : 0.0;
      const double y = fps.is_usable() ? fps.mean : kNoValue;
      ours.x.push_back(count);
      ours.y.push_back(y);
      ours.low.push_back(y - width);
      ours.high.push_back(y + width);
      if (method == "flat, no vertices") continue;
      theirs.x.push_back(count);
      theirs.y.push_back(published(table, model, count, method + "_mean"));
      if (fps.is_usable()) words += method + " at " + std::to_string(count) + ": " + cell_of(fps).text + ". ";
    }
    plot.curves.push_back(ours);
    if (!theirs.x.empty()) plot.curves.push_back(theirs);
  }
  plot.text.description = words.empty() ? "nothing was measured" : words;
  return {std::string(table) + "_" + model, svg(plot, Placement::kFile), svg(plot, Placement::kInline),
          model + ": measured (solid, band of one standard deviation) and published (dashed), on different machines."};
}

std::vector<std::string> models_of(const RowTable& rows) {
  std::vector<std::string> models;
  for (const auto& place : rows.places())
    if (models.empty() || models.back() != place.first) models.push_back(place.first);
  return models;
}

}  // namespace

void add_table5(Document& document, Rows all) {
  const RowTable rows(all, "table5");
  if (rows.is_empty()) return;
  document.blocks.emplace_back(Heading{"Table 5: levels A, B and C of the body octree", "table5"});
  document.blocks.emplace_back(Paragraph{
      "Random move. A tests level-2 boxes of all pairs of bodies, B level-1 boxes and where they overlap their level-2 "
      "children, C descends from level 0. All start from every pair of bodies, as published."});
  const std::vector<std::string> levels{"A", "B", "C"};
  Table table{"table5", "Frames per second: mean \xC2\xB1 standard deviation over runs", {"model", "bodies"}, {}};
  for (const char* kind : {"", " published", " ratio"})
    for (const std::string& level : levels) table.columns.push_back(level + kind);
  table.columns.insert(table.columns.end(), {"order", "order published"});
  for (const auto& [model, count] : rows.places()) {
    std::vector<TableCell> line{{model}, {std::to_string(count), static_cast<double>(count)}};
    std::vector<std::pair<std::string, Measured>> ours;
    std::vector<std::pair<std::string, Measured>> theirs;
    ours.reserve(levels.size());
    for (const std::string& level : levels) ours.emplace_back(level, fps_of(rows.find(model, count, level)));
    for (const std::string& level : levels) {
      Measured p;
      p.mean = published("table5", model, count, level + "_mean");
      p.deviation = published("table5", model, count, level + "_std");
      if (!std::isfinite(p.mean)) p.absence = "not published";
      theirs.emplace_back(level, p);
    }
    for (const auto& [level, value] : ours) line.push_back(cell_of(value));
    for (const auto& [level, value] : theirs) line.push_back(published_cell(value.mean, value.deviation));
    for (std::size_t k = 0; k < levels.size(); ++k) line.push_back(ratio_cell(ours[k].second, theirs[k].second.mean));
    line.push_back({ascending(ours)});
    line.push_back({ascending(theirs)});
    table.rows.push_back(std::move(line));
  }
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
  for (const std::string& model : models_of(rows))
    document.blocks.emplace_back(level_figure(rows, model, "table5", levels));
}

void add_table6(Document& document, Rows all) {
  const RowTable rows(all, "table6");
  if (rows.is_empty()) return;
  document.blocks.emplace_back(Heading{"Table 6: one box a body against the hierarchy", "table6"});
  document.blocks.emplace_back(
      Paragraph{"Random move. flat tests one box a body; with it the vertex stage looks at all vertices of both "
                "bodies. \"flat, no "
                "vertices\" stops at the boxes, as the published speed of flat suggests. The change is that of C "
                "against flat, the "
                "baseline; a negative one says that the hierarchy is slower."});
  Table table{"table6",
              "Frames per second: mean \xC2\xB1 standard deviation over runs; change of C against flat",
              {"model", "bodies", "flat", "C", "change", "flat, no vertices", "change against it", "flat published",
               "C published", "change published", "change as printed", "flat ratio", "C ratio"},
              {}};
  for (const auto& [model, count] : rows.places()) {
    const Measured flat = fps_of(rows.find(model, count, "flat"));
    const Measured bare = fps_of(rows.find(model, count, "flat, no vertices"));
    const Measured c = fps_of(rows.find(model, count, "C"));
    const double their_flat = published("table6", model, count, "flat_mean");
    const double their_c = published("table6", model, count, "C_mean");
    const auto change = [](const Measured& value, const Measured& base) {
      return change_cell(value.is_usable() ? value.mean : kNoValue, base.is_usable() ? base.mean : kNoValue);
    };
    const double printed = published("table6", model, count, "printed_change_percent");
    table.rows.push_back({{model},
                          {std::to_string(count), static_cast<double>(count)},
                          cell_of(flat),
                          cell_of(c),
                          change(c, flat),
                          cell_of(bare),
                          change(c, bare),
                          published_cell(their_flat, published("table6", model, count, "flat_std")),
                          published_cell(their_c, published("table6", model, count, "C_std")),
                          change_cell(their_c, their_flat),
                          number_cell(printed, 3),
                          ratio_cell(flat, their_flat),
                          ratio_cell(c, their_c)});
  }
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
  for (const std::string& model : models_of(rows))
    document.blocks.emplace_back(level_figure(rows, model, "table6", {"flat", "C", "flat, no vertices"}));
}

void add_figure4(Document& document, Rows all) {
  const RowTable rows(all, "figure4");
  if (rows.is_empty()) return;
  document.blocks.emplace_back(Heading{"Figure 4: level 1 against level 2", "figure4"});
  document.blocks.emplace_back(
      Paragraph{"Random move; boxes of one level alone, all pairs of them: 8 a body on level 1, 64 on level 2."});
  Table table{"figure4", "Frames per second", {"model", "bodies", "level", "FPS", "published", "ratio"}, {}};
  reports::plots::BarPlot plot;
  plot.text = {"Level 1 against level 2", "", "model and bodies", "frames per second"};
  plot.series = {{"level 1", {}, {}}, {"level 2", {}, {}}};
  for (const auto& [model, count] : rows.places()) {
    plot.groups.push_back(model + " " + std::to_string(count));
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string method = k == 0 ? "level 1" : "level 2";
      const Measured fps = fps_of(rows.find(model, count, method));
      const double theirs = published("figure4", model, count, k == 0 ? "level_1" : "level_2");
      table.rows.push_back({{model},
                            {std::to_string(count), static_cast<double>(count)},
                            {method},
                            cell_of(fps),
                            published_cell(theirs, kNoValue),
                            ratio_cell(fps, theirs)});
      plot.series[k].values.push_back(fps.is_usable() ? fps.mean : kNoValue);
      plot.series[k].errors.push_back(fps.deviation);
      plot.text.description += method + ", " + plot.groups.back() + ": " + cell_of(fps).text + ". ";
    }
  }
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
  document.blocks.emplace_back(Figure{"figure4", svg(plot, Placement::kFile), svg(plot, Placement::kInline),
                                      "Level 1 and level 2, mean and standard deviation over runs."});
}

}  // namespace broadside::bench::paper
