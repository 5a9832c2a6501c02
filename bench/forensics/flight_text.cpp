#include "bench/forensics/flight_text.hpp"

#include <fmt/format.h>

namespace broadside::bench {
namespace {

std::string declared(const core::TraceHeader& header, std::string_view key) {
  const core::Declaration& d = header.declaration;
  return std::string(d.text(key)) + (d.declares(key) ? "" : " (not declared)");
}

// "octree-cpu: order 1 in 1 substep, f32".
std::string party_text(const core::TraceHeader& header) {
  return fmt::format("{}: order {}, substeps {}, {}", header.stamp.engine, declared(header, "order"),
                     declared(header, "substeps"), declared(header, "precision"));
}

std::string contacts_text(const core::TraceHeader& header) {
  return fmt::format("{} has {} contacts, correction {}", header.stamp.engine, declared(header, "contact_model"),
                     declared(header, "correction"));
}

std::string moments_text(const FlightRule& rule, const core::TraceHeader& a, const core::TraceHeader& b) {
  if (!rule.detects_first() && !rule.replay_detects_first())
    return "Detection states and boxes are not compared: the engines look for contacts at different moments of the "
           "step. ";
  return fmt::format(
      "Detection states and boxes are not compared: {} looks for contacts before it moves the bodies, {} after, so "
      "these states are dt apart in time. ",
      (rule.detects_first() ? a : b).stamp.engine, (rule.detects_first() ? b : a).stamp.engine);
}

}  // namespace

std::string flight_expectation(const core::TraceHeader& a, const core::TraceHeader& b) {
  return fmt::format(
      "until a body is first touched, its states agree within what both engines declare: rounding, and at most h^2 g "
      "/ 2 a step of order 1 ({}; {}); a body that turns agrees within the allowances of the laws turning and "
      "gyroscopic, while their sum is below half a turn",
      party_text(a), party_text(b));
}

std::string flight_remark(const FlightRule& rule, const core::TraceHeader& a, const core::TraceHeader& b) {
  std::string text;
  if (rule.judged() > 0) text = fmt::format("{} states judged. ", rule.judged());
  if (!rule.is_one_moment())
    text += moments_text(rule, a, b);
  else if (rule.is_turning())
    text += "Boxes are not compared: those of bodies that turn may be loose. ";
  else if (rule.has_margin())
    text += fmt::format("Boxes are not compared: {} adds a margin of {} m to its own. ",
                        (a.broad_margin_m != 0.0 ? a : b).stamp.engine,
                        a.broad_margin_m != 0.0 ? a.broad_margin_m : b.broad_margin_m);
  if (rule.outgrown() > 0)
    text += fmt::format(
        "The orientation of {} bodies is not compared from step {} on: the allowance of both engines together has "
        "grown to half a turn. ",
        rule.outgrown(), rule.first_outgrown());
  if (rule.touches().count() > 0)
    text += fmt::format(
        "{} of {} bodies were touched, the first in step {}; from then on they are not compared, because no bound is "
        "derived for them. Their motions must differ there: {}, {}.",
        rule.touches().count(), a.scene.body_count(), rule.touches().first_step(), contacts_text(a), contacts_text(b));
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

}  // namespace broadside::bench
