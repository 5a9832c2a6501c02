// The report of the paper's experiments, from top to bottom.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bench/paper/measured.hpp"
#include "bench/paper/sections.hpp"
#include "datasets/published/published_figures.hpp"

namespace broadside::bench::paper {
namespace {

template <typename Value>
std::string list_of(Rows rows, Value value) {
  std::set<std::string> seen;
  std::string text;
  for (const PaperRow& row : rows) {
    const std::string one = value(row);
    if (!one.empty() && seen.insert(one).second) text += (text.empty() ? "" : "; ") + one;
  }
  return text.empty() ? "nothing" : text;
}

std::string lead(Rows rows) {
  std::size_t admitted = 0;
  std::size_t struck = 0;
  std::size_t absent = 0;
  for (const PaperRow& row : rows) {
    if (!row.absence.empty())
      ++absent;
    else
      ++(row.is_admitted ? admitted : struck);
  }
  return fmt::format(
      "{} cells: {} admitted, {} struck out, {} absent. A figure counts only when the same work was recorded, judged "
      "by every validator that applies without a failure, and ended in the recorded answer.",
      rows.size(), admitted, struck, absent);
}

void add_facts(Document& document, Rows rows, const PaperText& text) {
  document.blocks.emplace_back(Heading{"What ran, and where", "facts"});
  Notes notes;
  if (!text.device.empty()) notes.items.push_back(text.device);
  notes.items.push_back("Measured here: " + list_of(rows, [](const PaperRow& r) { return r.stamp.machine; }) + ".");
  notes.items.push_back("Published: " + std::string(datasets::kPublishedMachine) + ".");
  notes.items.push_back("Program: " + list_of(rows, [](const PaperRow& r) { return r.stamp.broadside_build; }) + ".");
  notes.items.push_back("Runs: " +
                        list_of(rows,
                                [](const PaperRow& r) {
                                  return r.runs.empty() ? ""
                                                        : fmt::format("{} of {} frames, {} of them recorded and judged",
                                                                      r.runs.size(), r.frames, r.judged);
                                }) +
                        ".");
  notes.items.push_back(
      "Meshes: " + list_of(rows, [](const PaperRow& r) { return r.mesh + (r.is_stand_in ? " (STAND-IN)" : ""); }) +
      ".");
  notes.items.push_back(
      "Domain, body scale, speeds and step are not published: those of these scenes are Broadside's own, so absolute "
      "figures cannot match. Ratios put both machines and both scenes in one number; only the orders can be compared.");
  if (!text.command.empty()) notes.items.push_back("Made with: " + text.command);
  document.blocks.emplace_back(std::move(notes));
}

}  // namespace

Table cell_table(Rows rows) {
  Table table{"cells",
              "Every cell",
              {"experiments", "model", "bodies", "method", "engine", "frames", "runs", "FPS", "admitted", "why not",
               "passed", "failed"},
              {}};
  for (const PaperRow& row : rows) {
    std::string experiments;
    for (const std::string& e : row.experiments) experiments += (experiments.empty() ? "" : " ") + e;
    std::string method = row.method;
    if (row.beta > 0.0) method += fmt::format(", beta {:g}, delta {:g} m", row.beta, row.delta_m);
    const auto count = [](std::uint64_t n) { return TableCell{std::to_string(n), static_cast<double>(n)}; };
    table.rows.push_back(
        {{experiments},
         {row.model},
         count(row.count),
         {method},
         {row.stamp.label()},
         count(row.frames),
         count(row.runs.size()),
         row.runs.empty() ? TableCell{row.absence.empty() ? "not timed" : "absent"} : cell_of(fps_of(&row)),
         {row.is_admitted ? "yes" : "no"},
         {row.absence.empty() ? row.refusal : row.absence},
         count(row.passed),
         count(row.failed)});
  }
  return table;
}

Document paper_document(Rows rows, const PaperText& text) {
  Document document{"The paper's experiments, repeated", lead(rows), {}};
  add_orderings(document, rows);
  add_table5(document, rows);
  add_table6(document, rows);
  add_table_a1(document, rows);
  add_memory(document, rows);
  add_figure4(document, rows);
  if (text.shows_models) add_figure_a1(document, text.models, text.allow_stand_in);
  add_figure_a2(document, rows);
  add_beyond(document, rows);
  add_errata(document, rows);
  add_facts(document, rows, text);
  return document;
}

}  // namespace broadside::bench::paper
