// Times of one scene: bars that share a scale among engines that did the same stages, and the figures beside them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/timing_groups.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kStageColors = 8;

// Round steps of 1, 2 or 5 times a power of ten, at most four of them up to the largest value.
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

// The largest value sets the axis, so the axis has a unit of its own.
std::string axis(const Scale& scale) {
  const TimeUnit unit = time_unit_for(scale.step_s);
  std::string out = "<svg class=\"axis\" width=\"100%\" height=\"16\" aria-hidden=\"true\">";
  for (double at = 0.0; at <= scale.end_s; at += scale.step_s) {
    const char* anchor = at == 0.0 ? "start" : at > 0.93 * scale.end_s ? "end" : "middle";
    out += "<text x=\"" + share(at, scale) + "\" y=\"11\" text-anchor=\"" + anchor + "\">" +
           figure(at * unit.per_second) + (at == 0.0 ? "" : " " + std::string(unit.name)) + "</text>";
  }
  return out + "</svg>";
}

// Means stack up to the mean frame exactly; medians would not. The tick is the median frame, the line p5 to p95.
std::string bar(const Timing& timing, const Scale& scale, TimeUnit unit) {
  std::string label = "Mean per frame:";
  std::string shapes;
  for (double at = scale.step_s; at <= scale.end_s; at += scale.step_s)
    shapes +=
        "<line class=\"grid\" x1=\"" + share(at, scale) + "\" x2=\"" + share(at, scale) + "\" y1=\"0\" y2=\"26\"/>";
  double left = 0.0;
  const auto segment = [&](const std::string& name, double mean, const std::string& style) {
    if (!(mean > 0.0)) return;
    const std::string value = time_in(unit, mean) + " " + std::string(unit.name);
    label += " " + name + " " + value + ",";
    shapes += "<rect class=\"" + style + "\" x=\"" + share(left, scale) + "\" y=\"4\" width=\"" + share(mean, scale) +
              "\" height=\"13\"><title>" + html(name + " " + value) + "</title></rect>";
    left += mean;
  };
  for (std::size_t k = 0; k < timing.stages.size(); ++k)
    segment(timing.stages[k].stage, timing.stages[k].seconds.mean, "s" + std::to_string(k % kStageColors));
  // Time that the stages do not account for, when it is more than the clock's own noise.
  if (timing.frame.mean - left > 0.005 * timing.frame.mean) segment("between stages", timing.frame.mean - left, "rest");
  shapes += "<line class=\"tail\" x1=\"" + share(timing.frame.p5, scale) + "\" x2=\"" + share(timing.frame.p95, scale) +
            "\" y1=\"22\" y2=\"22\"/><line class=\"median\" x1=\"" + share(timing.frame.median, scale) + "\" x2=\"" +
            share(timing.frame.median, scale) + "\" y1=\"18.5\" y2=\"25.5\"/>";
  label += " median frame " + time_in(unit, timing.frame.median) + " " + std::string(unit.name) + ".";
  return "<svg class=\"bar\" width=\"100%\" height=\"26\" role=\"img\" aria-label=\"" + html(label) + "\">" + shapes +
         "</svg>";
}

std::string fps_text(const Summary& fps) {
  std::string text = figure(fps.mean, 4);
  if (fps.count > 1) text += " \xC2\xB1 " + figure(fps.deviation, 2);
  return text;
}

std::string figure_cell(const std::string& name, const std::string& text, bool is_struck) {
  std::string out = "<td class=\"figure\" data-name=\"" + name + "\">";
  out += is_struck ? "<s>" + html(text) + "</s>" : html(text);
  return out + "</td>";
}

std::string frame_row(const Timing& timing, const Scale& scale, TimeUnit unit) {
  const bool is_struck = !timing.admission.is_admitted;
  std::string out = std::string("<tr") + (is_struck ? " class=\"struck\"" : "") + "><th scope=\"row\">" +
                    label_html(timing.stamp, timing.stamp.label());
  if (is_struck) out += "<small class=\"reason\">struck out: " + html(timing.admission.reason) + "</small>";
  if (!timing.admission.caveat.empty()) out += "<small>" + html(timing.admission.caveat) + "</small>";
  if (timing.frame_is_sum) out += "<small>frame = sum of its stages</small>";
  if (timing.frame.not_finite > 0)
    out += "<small>" + counted(timing.frame.not_finite, "time") + " not finite, left out</small>";
  out += "</th><td class=\"bars\" data-name=\"stages\">" + bar(timing, scale, unit) + "</td>";
  out += figure_cell("median, " + std::string(unit.name), time_in(unit, timing.frame.median), is_struck);
  out += figure_cell("p5 to p95, " + std::string(unit.name),
                     time_in(unit, timing.frame.p5) + " \xE2\x80\x93 " + time_in(unit, timing.frame.p95), is_struck);
  out += figure_cell("spread", percent(timing.frame.relative_spread), is_struck);
  out += figure_cell("FPS", fps_text(timing.fps), is_struck);
  out += figure_cell("frames", counted(timing.frame.count) + " in " + counted(timing.repetitions, "run"), false);
  return out + "</tr>";
}

std::string stage_head(const std::string& stage, std::size_t k) {
  return "<th scope=\"col\" class=\"figure\"><svg class=\"key\" width=\"10\" height=\"10\" aria-hidden=\"true\"><rect "
         "class=\"s" +
         std::to_string(k % kStageColors) + "\" width=\"10\" height=\"10\"/></svg> " + html(stage) + "</th>";
}

std::string stage_table(const TimingGroup& group, TimeUnit unit) {
  std::string out = "<table class=\"stages\"><caption>Median per stage in " + std::string(unit.name) +
                    ", and below it the 5th to 95th percentile</caption><thead><tr><th scope=\"col\">engine</th>";
  for (std::size_t k = 0; k < group.stages.size(); ++k) out += stage_head(group.stages[k], k);
  out += "</tr></thead><tbody>";
  for (const Timing* timing : group.timings) {
    const bool is_struck = !timing->admission.is_admitted;
    out += std::string("<tr") + (is_struck ? " class=\"struck\"" : "") + "><th scope=\"row\">" +
           label_html(timing->stamp, timing->stamp.label()) + "</th>";
    for (const StageTiming& stage : timing->stages) {
      const Summary& s = stage.seconds;
      const std::string tails = time_in(unit, s.p5) + " \xE2\x80\x93 " + time_in(unit, s.p95);
      const std::string body = time_in(unit, s.median) + "<small>" + tails + "</small>";
      out += "<td class=\"figure\" data-name=\"" + html(stage.stage) + "\">" +
             (is_struck ? "<s>" + body + "</s>" : body) + "</td>";
    }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

std::string group_html(const TimingGroup& group) {
  const Scale scale = scale_of(group);
  double smallest = 0.0;
  for (const Timing* timing : group.timings)
    if (timing->frame.median > 0.0)
      smallest = smallest == 0.0 ? timing->frame.median : std::min(smallest, timing->frame.median);
  const TimeUnit unit = time_unit_for(smallest);
  std::string work;
  for (const std::string& stage : group.stages) work += (work.empty() ? "" : " \xE2\x86\x92 ") + stage;
  std::string out =
      "<h4>" + (work.empty() ? "whole frames" : html(work)) +
      "</h4><table class=\"times\"><thead><tr><th "
      "scope=\"col\">engine</th><th scope=\"col\" class=\"bars\"><span class=\"unseen\">time per frame</span>" +
      axis(scale) + "</th><th scope=\"col\" class=\"figure\">median<small>" + std::string(unit.name) +
      " per frame</small></th><th scope=\"col\" class=\"figure\">p5 \xE2\x80\x93 p95<small>" + std::string(unit.name) +
      "</small></th><th scope=\"col\" class=\"figure\">spread<small>quartiles</small>"
      "</th><th scope=\"col\" class=\"figure\">FPS<small>mean \xC2\xB1 s.d. of runs</small></th><th "
      "scope=\"col\" class=\"figure\">frames</th></tr></thead><tbody>";
  for (const Timing* timing : group.timings) out += frame_row(*timing, scale, unit);
  out += "</tbody></table>";
  if (group.stages.size() > 1) out += stage_table(group, unit);
  return out;
}

}  // namespace

std::string times_section(const SceneView& scene, PageParts&) {
  std::string out = "<section class=\"timing\"><h3>Times</h3>";
  if (scene.timings.empty()) return out + "<p>Not measured: no timed run is among these rows.</p></section>";
  out +=
      "<p class=\"hint\">Bars stack the mean of each stage; the tick is the median frame, the line below runs from the "
      "5th "
      "to the 95th percentile. Engines share a scale only where they report the same stages.</p>";
  for (const TimingGroup& group : groups_of(scene)) out += group_html(group);
  return out + "</section>";
}

}  // namespace broadside::reports
