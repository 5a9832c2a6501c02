#include "reports/terminal_table.hpp"

#include <algorithm>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/scene_view.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

using Line = std::vector<std::string>;

std::string padded(const std::string& text, std::size_t columns) {
  const std::size_t used = width(text);
  return used < columns ? text + std::string(columns - used, ' ') : text;
}

// Columns are as wide as their widest entry; the last one gets the rest of the line and is cut at its end.
std::string table(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths;
  for (const Line& line : lines) {
    widths.resize(std::max(widths.size(), line.size()), 0);
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));
  }
  std::string text;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const bool is_last = c + 1 == line.size();
      row += is_last ? line[c] : padded(line[c], widths[c]) + "  ";
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += clipped(row, kTerminalColumns) + "\n";
  }
  return text;
}

std::string_view short_word(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return "pass";
    case core::Outcome::kFail:
      return "FAIL";
    case core::Outcome::kInconclusive:
      return "unsure";
    case core::Outcome::kNotApplicable:
      return "n/a";
  }
  return "";
}

std::string long_word(core::Outcome outcome) {
  return outcome == core::Outcome::kFail ? "FAIL" : std::string(core::outcome_word(outcome));
}

std::string name_of(const TraceView& trace) {
  std::string text = printable(trace.label);
  for (std::size_t k = 0; k < trace.baselines.size(); ++k)
    text += (k == 0 ? " against " : ", ") + printable(trace.baselines[k]);
  return text;
}

// "9 of 14 laws of mechanics applied, 5 of 7 of the trace", and whether that proves a motion.
std::string coverage_lines(const TraceView& trace, const std::string& before) {
  if (!trace.is_judged()) return "";
  const std::string text = before + core::coverage_text(trace.coverage());
  return trace.is_simulation && !trace.has_proven_motion() ? text + "\n" + before + "its motion was not proven\n"
                                                           : text + "\n";
}

std::string one_trace(const SceneView& scene, const TraceView& trace) {
  std::vector<Line> lines{{"validator", "verdict", "measured", "limit", "worst at"}};
  for (std::size_t c = 0; c < scene.validators.size(); ++c) {
    for (const core::Verdict* verdict : trace.verdicts[c]) {
      const std::string name = clipped(printable(verdict->validator), 24);
      if (verdict->outcome == core::Outcome::kNotApplicable) {
        lines.push_back({name, long_word(verdict->outcome), "", "", printable(verdict->explanation)});
        continue;
      }
      const Compared values = compared(verdict->measured, verdict->limit, verdict->unit);
      lines.push_back({name, long_word(verdict->outcome), clipped(printable(values.measured), 14),
                       clipped(printable(values.limit), 14), printable(place_text(verdict->worst))});
    }
  }
  return printable(scene.name) + ": " + name_of(trace) + "\n" + table(lines) + coverage_lines(trace, "");
}

// The matrix in blocks; a block has as many traces as fit beside the names of the validators.
std::string matrix(const SceneView& scene) {
  constexpr std::size_t kCellWidth = 8;
  std::size_t name_width = 9;
  for (const std::string& validator : scene.validators)
    name_width = std::max(name_width, std::min<std::size_t>(24, width(printable(validator))));
  const std::size_t per_block = (kTerminalColumns - name_width - 2) / kCellWidth;

  std::string text;
  for (std::size_t first = 0; first < scene.traces.size(); first += per_block) {
    const std::size_t last = std::min(first + per_block, scene.traces.size());
    for (std::size_t t = first; t < last; ++t)
      text += clipped("[" + std::to_string(t + 1) + "] " + name_of(scene.traces[t]), kTerminalColumns) + "\n";
    std::vector<Line> lines{{"validator"}};
    for (std::size_t t = first; t < last; ++t)
      lines[0].push_back(padded("[" + std::to_string(t + 1) + "]", kCellWidth - 2));
    for (std::size_t c = 0; c < scene.validators.size(); ++c) {
      Line line{padded(clipped(printable(scene.validators[c]), 24), name_width)};
      for (std::size_t t = first; t < last; ++t) {
        const auto& said = scene.traces[t].verdicts[c];
        line.emplace_back(said.empty() ? "none" : short_word(said.front()->outcome));
      }
      lines.push_back(std::move(line));
    }
    text += table(lines);
    for (std::size_t t = first; t < last; ++t)
      text += coverage_lines(scene.traces[t], "[" + std::to_string(t + 1) + "] ");
    if (last < scene.traces.size()) text += "\n";
  }
  return printable(scene.name) + "\n" + text;
}

// The line of a law that is part of a failed verdict.
std::string part_line(const std::string& label, const core::Verdict& whole, const core::Verdict& part) {
  const Compared values = compared(part.measured, part.limit, part.unit);
  return label + ": " + whole.validator + ", " + part.validator + ": " + std::to_string(part.violations) + " of " +
         std::to_string(part.checked) + " FAIL: measured " + values.measured + ", limit " + values.limit + ", at " +
         place_text(part.worst) + " (limit: " + part.origin + ")";
}

}  // namespace

std::string verdict_table(const std::vector<core::CellVerdicts>& verdicts) {
  const core::RunRows rows{.verdicts = verdicts};
  const std::vector<SceneView> scenes = by_scene(rows);
  if (scenes.empty()) return "no verdicts\n";
  std::string text;
  for (const SceneView& scene : scenes) {
    if (!text.empty()) text += "\n";
    text += scene.traces.size() == 1 ? one_trace(scene, scene.traces[0]) : matrix(scene);
  }
  return text;
}

std::string cell_table(const std::vector<core::Cell>& cells) {
  if (cells.empty()) return "no cells\n";
  std::vector<Line> lines{{"engine", "state", "frames", "wall", "trace, or why there is none"}};
  for (const core::Cell& cell : cells) {
    const bool has_run = cell.frames > 0 || cell.state == core::CellState::kRecorded;
    std::string last = cell.reason;
    if (!cell.trace_file.empty()) last += (last.empty() ? "" : "; ") + cell.trace_file;
    lines.push_back({clipped(printable(cell.stamp.label()), 40), std::string(core::cell_state_word(cell.state)),
                     has_run ? std::to_string(cell.frames) : "none", has_run ? quantity(cell.wall_s, "s") : "none",
                     printable(last)});
  }
  return table(lines);
}

std::string failure_lines(const std::vector<core::CellVerdicts>& verdicts) {
  std::string text;
  for (const core::CellVerdicts& cell : verdicts) {
    for (const core::Verdict& verdict : cell.verdicts) {
      if (severity(verdict.outcome) < severity(core::Outcome::kInconclusive)) continue;
      const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
      std::string line = cell.stamp.label() + ": " + verdict.validator + " ";
      line += verdict.outcome == core::Outcome::kFail ? "FAIL" : "inconclusive";
      line += ": measured " + values.measured + ", limit " + values.limit + ", at " + place_text(verdict.worst);
      if (!verdict.baseline.empty()) line += ", against " + verdict.baseline;
      if (!verdict.explanation.empty()) line += "; " + verdict.explanation;
      if (!verdict.origin.empty()) line += " (limit: " + verdict.origin + ")";
      text += printable(line) + "\n";
      for (const core::Verdict& part : verdict.parts)
        if (part.outcome == core::Outcome::kFail)
          text += printable(part_line(cell.stamp.label(), verdict, part)) + "\n";
    }
  }
  return text;
}

std::string warning_lines(const std::vector<core::CellVerdicts>& verdicts) {
  std::string text;
  for (const core::CellVerdicts& cell : verdicts)
    for (const core::Verdict& verdict : cell.verdicts) {
      const std::size_t at = verdict.explanation.find("warning: ");
      if (severity(verdict.outcome) >= severity(core::Outcome::kInconclusive) || at == std::string::npos) continue;
      text += printable(cell.stamp.label() + ": " + verdict.validator + ": " + verdict.explanation.substr(at)) + "\n";
    }
  return text;
}

}  // namespace broadside::reports
