// Times of one scene: bars with a common scale for engines that did the same stages, and the figures beside them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/timing_groups.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kStageColors = 8;

// Round steps of 1, 2 or 5 times a power of ten, at most four of them from zero to the largest value.
struct Scale {
  double step_s = 1.0;
  double end_s = 1.0;
};

Scale scale_of(const TimingGroup& group) {
  double largest = 0.0;
  for (const Timing* timing : group.timings)
    for (const double value : {timing->frame.p95, timing->frame.mean})
      if (std::isfinite(value)) largest = std::max(largest, value);
  if (largest <= 0.0) return {};
  double step = std::pow(10.0, std::floor(std::log10(largest / 4.0)));
  for (const double factor : {2.0, 2.5, 2.0})
    if (step * 4.0 < largest) step *= factor;
  return {step, std::max(largest * 1.02, step)};
}

std::string share(double value, const Scale& scale) {
  std::array<char, 32> text;
  const double percent_of = std::isfinite(value) ? std::clamp(100.0 * value / scale.end_s, 0.0, 100.0) : 0.0;
  std::snprintf(text.data(), text.size(), "%.2f%%", percent_of);
  return text.data();
}

// The axis has a unit of its own, chosen by the largest value.
std::string axis(const Scale& scale) {
  const TimeUnit unit = time_unit_for(scale.step_s);
  std::string ticks;
  for (int k = 0; k * scale.step_s <= scale.end_s; ++k) {
    const double at = k * scale.step_s;
    const char* anchor = k == 0 ? "start" : at > 0.93 * scale.end_s ? "end" : "middle";
    ticks += element("text", {{"x", share(at, scale)}, {"y", "11"}, {"text-anchor", anchor}},
                     figure(at * unit.per_second), k == 0 ? "" : " " + std::string(unit.name));
  }
  return element("svg.axis", {{"width", "100%"}, {"height", "16"}, {"aria-hidden", "true"}}, ticks);
}

// A line in the picture of a bar: across from `from` to `to` at a height, or upright at one place.
std::string across(std::string_view style, const std::string& from, const std::string& to, const std::string& y) {
  return element(style, {{"x1", from}, {"x2", to}, {"y1", y}, {"y2", y}});
}
std::string down(std::string_view style, const std::string& x, const std::string& from, const std::string& to) {
  return element(style, {{"x1", x}, {"x2", x}, {"y1", from}, {"y2", to}});
}

// The means of stages add up to the mean frame exactly, medians would not. The tick is the median frame, the line p5 to
// p95.
std::string bar(const Timing& timing, const Scale& scale, TimeUnit unit) {
  std::string label = "Mean per frame:";
  std::string shapes;
  for (int k = 1; k * scale.step_s <= scale.end_s; ++k)
    shapes += down("line.grid", share(k * scale.step_s, scale), "0", "26");
  double left = 0.0;
  const auto segment = [&](const std::string& name, double mean, const std::string& style) {
    if (!(mean > 0.0)) return;
    const std::string value = time_in(unit, mean) + " " + std::string(unit.name);
    label += " " + name + " " + value + ",";
    shapes += element("rect." + style,
                      {{"x", share(left, scale)}, {"y", "4"}, {"width", share(mean, scale)}, {"height", "13"}},
                      element("title", html(name + " " + value)));
    left += mean;
  };
  for (std::size_t k = 0; k < timing.stages.size(); ++k)
    segment(timing.stages[k].stage, timing.stages[k].seconds.mean, "s" + std::to_string(k % kStageColors));
  // The time between the stages, where it is more than the noise of the clock.
  if (timing.frame.mean - left > 0.005 * timing.frame.mean) segment("between stages", timing.frame.mean - left, "rest");
  shapes += across("line.tail", share(timing.frame.p5, scale), share(timing.frame.p95, scale), "22");
  shapes += down("line.median", share(timing.frame.median, scale), "18.5", "25.5");
  label += " median frame " + time_in(unit, timing.frame.median) + " " + std::string(unit.name) + ".";
  return element("svg.bar", {{"width", "100%"}, {"height", "26"}, {"role", "img"}, {"aria-label", label}}, shapes);
}

std::string fps_text(const Summary& fps) {
  std::string text = figure(fps.mean, 4);
  if (fps.count > 1) text += " \u00B1 " + figure(fps.deviation, 2);
  return text;
}

std::string time_cell(const std::string& name, const std::string& text, bool is_struck) {
  return figure_cell(name, is_struck ? element("s", html(text)) : html(text));
}

std::string frame_row(const Timing& timing, const Scale& scale, TimeUnit unit) {
  const bool is_struck = !timing.admission.is_admitted;
  std::string head = label_html(timing.stamp, timing.stamp.label());
  if (is_struck) head += element("small.reason", "struck out: ", html(timing.admission.reason));
  if (!timing.admission.caveat.empty()) head += element("small", html(timing.admission.caveat));
  if (timing.frame_is_sum) head += element("small", "frame = sum of its stages");
  if (timing.frame.not_finite > 0)
    head += element("small", counted(timing.frame.not_finite, "time"), " not finite, left out");
  const std::string in_unit = ", " + std::string(unit.name);
  const std::string tails = time_in(unit, timing.frame.p5) + " \u2013 " + time_in(unit, timing.frame.p95);
  return element(is_struck ? "tr.struck" : "tr", row_head(head),
                 element("td.bars", {{"data-name", "stages"}}, bar(timing, scale, unit)),
                 time_cell("median" + in_unit, time_in(unit, timing.frame.median), is_struck),
                 time_cell("p5 to p95" + in_unit, tails, is_struck),
                 time_cell("spread", percent(timing.frame.relative_spread), is_struck),
                 time_cell("FPS", fps_text(timing.fps), is_struck),
                 figure_cell("frames", counted(timing.frame.count) + " in " + counted(timing.repetitions, "run")));
}

std::string stage_head(const std::string& stage, std::size_t k) {
  const std::string color = element("rect.s" + std::to_string(k % kStageColors), {{"width", "10"}, {"height", "10"}});
  return element("th.figure", {{"scope", "col"}},
                 element("svg.key", {{"width", "10"}, {"height", "10"}, {"aria-hidden", "true"}}, color), " ",
                 html(stage));
}

std::string stage_row(const Timing& timing, TimeUnit unit) {
  const bool is_struck = !timing.admission.is_admitted;
  std::string cells;
  for (const StageTiming& stage : timing.stages) {
    const Summary& s = stage.seconds;
    const std::string tails = time_in(unit, s.p5) + " \u2013 " + time_in(unit, s.p95);
    const std::string body = time_in(unit, s.median) + element("small", tails);
    cells += figure_cell(stage.stage, is_struck ? element("s", body) : body);
  }
  return element(is_struck ? "tr.struck" : "tr", row_head(label_html(timing.stamp, timing.stamp.label())), cells);
}

std::string stage_table(const TimingGroup& group, TimeUnit unit) {
  std::string heads = column_head({"engine"});
  for (std::size_t k = 0; k < group.stages.size(); ++k) heads += stage_head(group.stages[k], k);
  std::string rows;
  for (const Timing* timing : group.timings) rows += stage_row(*timing, unit);
  return element("table.stages",
                 element("caption", "Median per stage in ", unit.name, ", and below it the 5th to 95th percentile"),
                 element("thead", element("tr", heads)), element("tbody", rows));
}

std::string group_html(const TimingGroup& group) {
  const Scale scale = scale_of(group);
  double smallest = 0.0;
  for (const Timing* timing : group.timings)
    if (timing->frame.median > 0.0)
      smallest = smallest == 0.0 ? timing->frame.median : std::min(smallest, timing->frame.median);
  const TimeUnit unit = time_unit_for(smallest);
  std::string work;
  for (const std::string& stage : group.stages) work += (work.empty() ? "" : " \u2192 ") + stage;
  const std::string time_unit(unit.name);
  const std::string heads =
      column_head({"engine"}) +
      element("th.bars", {{"scope", "col"}}, element("span.unseen", "time per frame"), axis(scale)) +
      column_head({"median", true, time_unit + " per frame"}) + column_head({"p5 \u2013 p95", true, time_unit}) +
      column_head({"spread", true, "quartiles"}) + column_head({"FPS", true, "mean \u00B1 s.d. of runs"}) +
      column_head({"frames", true});
  std::string rows;
  for (const Timing* timing : group.timings) rows += frame_row(*timing, scale, unit);
  return element("h4", work.empty() ? "whole frames" : html(work)) +
         element("table.times", element("thead", element("tr", heads)), element("tbody", rows)) +
         (group.stages.size() > 1 ? stage_table(group, unit) : "");
}

}  // namespace

std::string times_section(const SceneView& scene, PageParts&) {
  const std::string title = element("h3", "Times");
  if (scene.timings.empty())
    return element("section.timing", title, element("p", "Not measured: no timed run is among these rows."));
  std::string groups;
  for (const TimingGroup& group : groups_of(scene)) groups += group_html(group);
  return element("section.timing", title,
                 element("p.hint",
                         "Bars stack the mean of each stage; the tick is the median frame, the line below runs from "
                         "the 5th to the 95th percentile. Engines share a scale only where they report the same "
                         "stages."),
                 groups);
}

}  // namespace broadside::reports
