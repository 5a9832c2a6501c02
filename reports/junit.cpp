// JUnit XML; how outcomes are mapped is documented in report.hpp.
#include <cmath>
#include <cstdio>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/report.hpp"
#include "reports/scene_view.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

struct Counts {
  std::uint64_t tests = 0, failures = 0, errors = 0, skipped = 0;
};

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + xml(value) + "\"";
}

std::string seconds_text(double seconds) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6f", std::isfinite(seconds) && seconds > 0.0 ? seconds : 0.0);
  return text;
}

std::string attributes(const Counts& c) {
  return attribute("tests", std::to_string(c.tests)) + attribute("failures", std::to_string(c.failures)) +
         attribute("errors", std::to_string(c.errors)) + attribute("skipped", std::to_string(c.skipped));
}

std::string one_line(const core::Verdict& verdict) {
  const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
  return "measured " + values.measured + ", limit " + values.limit + ", worst at " + place_text(verdict.worst);
}

// The laws that a verdict sums up and that did not hold, a line each.
std::string parts_text(const core::Verdict& verdict) {
  std::string text;
  for (const core::Verdict& part : verdict.parts)
    if (part.outcome == core::Outcome::kFail)
      text += "\n" + part.validator + ": " + one_line(part) + "; " + part.explanation;
  return text;
}

std::string whole_text(const core::Verdict& verdict) {
  return verdict.explanation + " (" + std::to_string(verdict.violations) + " violations in " +
         std::to_string(verdict.checked) + " checked; limit: " + verdict.origin + ")" + parts_text(verdict);
}

std::string verdict_case(const core::Verdict& verdict, const std::string& class_name, Counts& counts) {
  const std::string name =
      verdict.baseline.empty() ? verdict.validator : verdict.validator + " against " + verdict.baseline;
  std::string out = "    <testcase" + attribute("classname", class_name) + attribute("name", name) + " time=\"0\"";
  ++counts.tests;
  switch (verdict.outcome) {
    case core::Outcome::kPass:
      return out + "/>\n";
    case core::Outcome::kFail:
      ++counts.failures;
      out += "><failure type=\"fail\"" + attribute("message", one_line(verdict)) + ">" + xml(whole_text(verdict)) +
             "</failure>";
      break;
    case core::Outcome::kInconclusive:
      ++counts.errors;
      out += "><error type=\"inconclusive\"" + attribute("message", one_line(verdict)) + ">" +
             xml(whole_text(verdict)) + "</error>";
      break;
    case core::Outcome::kNotApplicable:
      ++counts.skipped;
      out += "><skipped" + attribute("message", "not applicable: " + verdict.explanation) + "/>";
      break;
  }
  return out + "</testcase>\n";
}

std::string property(std::string_view name, std::string_view value) {
  return "      <property" + attribute("name", name) + attribute("value", value) + "/>\n";
}

// The schema requires the properties before the cases.
std::string properties(const TraceView& trace) {
  if (!trace.is_judged()) return "";
  std::string out = property("coverage", core::coverage_text(trace.coverage()));
  if (trace.is_simulation)
    out += property("motion", trace.has_proven_motion() ? "proven" : "its motion was not proven");
  for (const auto& [key, text] : trace.declaration) out += property("declaration." + key, text);
  return "    <properties>\n" + out + "    </properties>\n";
}

std::string recorded_case(const TraceView& trace, const std::string& class_name, Counts& counts) {
  if (trace.cell == nullptr) return "";
  const core::Cell& cell = *trace.cell;
  std::string out = "    <testcase" + attribute("classname", class_name) + " name=\"recorded\"" +
                    attribute("time", seconds_text(cell.wall_s));
  ++counts.tests;
  switch (cell.state) {
    case core::CellState::kRecorded:
      return out + "/>\n";
    case core::CellState::kNotMeasured:
    case core::CellState::kUnsupported:
      ++counts.skipped;
      out += "><skipped" + attribute("message", state_text(cell)) + "/>";
      break;
    default:
      ++counts.errors;
      out += "><error" + attribute("type", core::cell_state_word(cell.state)) + attribute("message", state_text(cell)) +
             "/>";
      break;
  }
  return out + "</testcase>\n";
}

}  // namespace

std::string junit_xml(const core::RunRows& rows, const ReportOptions& options) {
  Counts total;
  double total_s = 0.0;
  std::string suites;
  // Scene views have one verdict per baseline and no repetitions, so names within a suite differ.
  const std::vector<SceneView> scenes = by_scene(rows);
  for (const SceneView& scene : scenes) {
    for (const TraceView& trace : scene.traces) {
      Counts counts;
      const std::string name = scene.name + ": " + trace.label;
      std::string cases = recorded_case(trace, name, counts);
      for (const auto& said : trace.verdicts)
        for (const core::Verdict* verdict : said) cases += verdict_case(*verdict, name, counts);
      const double wall_s = trace.cell != nullptr ? trace.cell->wall_s : 0.0;
      suites += "  <testsuite" + attribute("name", name) + attributes(counts) + attribute("time", seconds_text(wall_s));
      if (!options.generated_at.empty()) suites += attribute("timestamp", options.generated_at);
      suites += ">\n" + properties(trace) + cases + "  </testsuite>\n";
      total.tests += counts.tests;
      total.failures += counts.failures;
      total.errors += counts.errors;
      total.skipped += counts.skipped;
      if (std::isfinite(wall_s)) total_s += wall_s;
    }
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
         attribute("name", options.title.empty() ? kDefaultTitle : options.title) + attributes(total) +
         attribute("time", seconds_text(total_s)) + ">\n" + suites + "</testsuites>\n";
}

}  // namespace broadside::reports
