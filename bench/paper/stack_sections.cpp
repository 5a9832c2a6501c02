// P-Table A1, Figure 5 and the memory table: spatial hash against octree in free fall.
#include <cmath>

#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "datasets/published/published_figures.hpp"
#include "reports/plots/bar_plot.hpp"
#include "reports/plots/line_plot.hpp"
#include "reports/statistics.hpp"

namespace broadside::bench::paper {
namespace {

using datasets::published_table;
using datasets::PublishedTable;
using reports::plots::Placement;

// Figure 5 for one model: the FPS of each method, window by window.
Figure fps_over_frames(const RowTable& rows, const std::string& model, std::uint32_t count) {
  reports::plots::LinePlot plot;
  plot.text = {model + " " + std::to_string(count) + ": frames per second over the run", "", "frame",
               "frames per second"};
  for (const char* method : {"hash", "octree"}) {
    reports::plots::Curve curve{.name = method};
    const PaperRow* row = rows.find(model, count, method);
    const std::size_t windows = row != nullptr && row->is_admitted ? row->window_count() : 0;
    for (std::size_t w = 0; w < windows; ++w) {
      const Measured fps = measured(row, row->window_fps(w));
      const double width = std::isfinite(fps.deviation) ? fps.deviation : 0.0;
      curve.x.push_back(static_cast<double>(w * row->window_frames + row->frames_in(w)));
      curve.y.push_back(fps.mean);
      curve.low.push_back(fps.mean - width);
      curve.high.push_back(fps.mean + width);
    }
    if (!curve.y.empty())
      plot.text.description += std::string(method) + ": from " + cell_of({.mean = curve.y.front()}).text + " to " +
                               cell_of({.mean = curve.y.back()}).text + " FPS. ";
    plot.curves.push_back(std::move(curve));
  }
  return {"figure5_" + model, svg(plot, Placement::kFile), svg(plot, Placement::kInline),
          model + ": FPS of each window of frames, mean and one standard deviation over runs."};
}

Measured half(const PaperRow* row, bool is_early) {
  return measured(row, row == nullptr ? std::vector<double>{} : row->half_fps(is_early));
}

double usable(const Measured& value) {
  return value.is_usable() ? value.mean : kNoValue;
}

}  // namespace

void add_table_a1(Document& document, Rows all) {
  const RowTable rows(all, "tableA1");
  if (rows.is_empty()) return;
  const std::uint64_t frames = rows.rows().front()->frames;
  document.blocks.emplace_back(Heading{"Table A1 and Figure 5: spatial hash against octree", "tableA1"});
  document.blocks.emplace_back(Paragraph{
      "Free-fall stacking, both on the same device and with the same later stages. Early is the first half of the " +
      std::to_string(frames) +
      " frames, late the second. The gain is that of the octree over the hash, the baseline; "
      "the paper divides by the octree's FPS instead, and that figure stands beside it."});
  Table table{
      "tableA1",
      "Frames per second: mean \xC2\xB1 standard deviation over runs",
      {"model", "bodies", "part", "hash", "octree", "gain over hash", "gain as the paper divides", "hash published",
       "octree published", "gain published, over hash", "as printed, %", "hash ratio", "octree ratio"},
      {}};
  const PublishedTable& published = published_table("tableA1");
  for (const auto& [model, count] : rows.places()) {
    const auto at = published.find(model, count);
    for (const bool is_early : {true, false}) {
      const std::string part = is_early ? "early" : "late";
      const Measured hash = half(rows.find(model, count, "hash"), is_early);
      const Measured octree = half(rows.find(model, count, "octree"), is_early);
      const double their_hash = at ? published.number(*at, part + "_hash") : kNoValue;
      const double their_octree = at ? published.number(*at, part + "_octree") : kNoValue;
      // (octree - hash) / octree = -(change of hash against octree).
      TableCell as_paper = change_cell(usable(hash), usable(octree));
      if (std::isfinite(as_paper.value)) as_paper = number_cell(-as_paper.value, 3), as_paper.text += " %";
      table.rows.push_back({{model},
                            {std::to_string(count), static_cast<double>(count)},
                            {part},
                            cell_of(hash),
                            cell_of(octree),
                            change_cell(usable(octree), usable(hash)),
                            as_paper,
                            published_cell(their_hash, kNoValue),
                            published_cell(their_octree, kNoValue),
                            change_cell(their_octree, their_hash),
                            number_cell(at ? published.number(*at, part + "_printed_rcr_percent") : kNoValue, 4),
                            ratio_cell(hash, their_hash),
                            ratio_cell(octree, their_octree)});
    }
  }
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
  for (const auto& [model, count] : rows.places()) document.blocks.emplace_back(fps_over_frames(rows, model, count));
}

void add_memory(Document& document, Rows all) {
  const RowTable rows(all, "memory");
  if (rows.is_empty()) return;
  document.blocks.emplace_back(Heading{"Memory", "memory"});
  std::string kinds;
  for (const PaperRow* row : rows.rows()) {
    const std::string kind = row->method + ": " + row->memory_kind;
    if (!row->memory_kind.empty() && kinds.find(kind) == std::string::npos) kinds += (kinds.empty() ? "" : "; ") + kind;
  }
  document.blocks.emplace_back(Paragraph{
      "Free-fall stacking. Counted here (" + (kinds.empty() ? "nothing" : kinds) +
      "): what the engine holds beyond what was in use before it was made, sampled at the end of each window. The "
      "published figures are megabytes of a program in Unity, which holds more than the engine."});
  Table table{"memory",
              "Megabytes (10^6 bytes): mean \xC2\xB1 standard deviation over runs",
              {"model", "bodies", "hash", "octree", "octree against hash", "hash published", "octree published",
               "octree against hash, published", "hash ratio", "octree ratio"},
              {}};
  reports::plots::BarPlot plot;
  plot.text = {"Memory held by the engine", "", "model", "MB"};
  plot.series = {{"hash", {}, {}}, {"octree", {}, {}}};
  const PublishedTable& published = published_table("memory");
  for (const auto& [model, count] : rows.places()) {
    const auto at = published.find(model, count);
    Measured ours[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const PaperRow* row = rows.find(model, count, k == 0 ? "hash" : "octree");
      std::vector<double> megabytes;
      if (row != nullptr)
        for (const double bytes : row->memory_bytes) megabytes.push_back(bytes / 1e6);
      ours[k] = measured(row, megabytes);
      plot.series[k].values.push_back(usable(ours[k]));
      plot.series[k].errors.push_back(ours[k].deviation);
      plot.text.description += model + ", " + plot.series[k].name + ": " + cell_of(ours[k]).text + " MB. ";
    }
    plot.groups.push_back(model);
    const auto theirs = [&](const std::string& column) { return at ? published.number(*at, column) : kNoValue; };
    table.rows.push_back({{model},
                          {std::to_string(count), static_cast<double>(count)},
                          cell_of(ours[0]),
                          cell_of(ours[1]),
                          change_cell(usable(ours[1]), usable(ours[0])),
                          published_cell(theirs("hash_mean"), theirs("hash_std")),
                          published_cell(theirs("octree_mean"), theirs("octree_std")),
                          change_cell(theirs("octree_mean"), theirs("hash_mean")),
                          ratio_cell(ours[0], theirs("hash_mean")),
                          ratio_cell(ours[1], theirs("octree_mean"))});
  }
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
  document.blocks.emplace_back(Figure{"memory", svg(plot, Placement::kFile), svg(plot, Placement::kInline),
                                      "Memory of spatial hash and octree, mean and standard deviation over runs."});
}

}  // namespace broadside::bench::paper
