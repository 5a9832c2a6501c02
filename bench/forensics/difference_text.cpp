#include "bench/forensics/difference_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/math/ulps.hpp"
#include "validation/tally.hpp"

namespace broadside::bench {
namespace {

using core::DifferenceKind;
using core::FrameDifference;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : ", ") + w;
  return text;
}

std::string bodies_text(const FrameDifference& d) {
  std::string text;
  for (std::uint32_t k = 0; k < d.body_count; ++k) text += (k == 0 ? "" : " and ") + validation::body_text(d.bodies[k]);
  return text;
}

std::string field_text(const FrameDifference& d) {
  const std::string_view element = d.element_name();
  return std::string(d.field) + (element.empty() || d.kind != DifferenceKind::kValue ? "" : "." + std::string(element));
}

std::string kind_text(const FrameDifference& d) {
  const bool is_of_points = d.field.starts_with("/trace/point");
  switch (d.kind) {
    case DifferenceKind::kOnlyInA:
      return "only in A";
    case DifferenceKind::kOnlyInB:
      return "only in B";
    case DifferenceKind::kOrder:
      return is_of_points ? "points of the same bodies in another order" : "the same pairs in another order";
    case DifferenceKind::kValue:
      break;
  }
  return "another value";
}

bool is_real(const FrameDifference& d) {
  return d.a.element == core::Element::kF32 || d.a.element == core::Element::kF64;
}

std::string distance_text(const FrameDifference& d) {
  const std::uint64_t ulps = core::ulps_between(d.a, d.b);
  if (!is_real(d)) return d.field == "/trace/digest" ? "no distance is defined" : fmt::format("apart by {}", ulps);
  if (ulps == core::kNoUlps) return "no distance in ulps: one is not a number";
  if (ulps == 0) return "zeros of unlike sign";
  return fmt::format("{} ulp{}, apart by {:.4g}", ulps, ulps == 1 ? "" : "s", std::abs(d.a.value() - d.b.value()));
}

std::string number_text(const FrameDifference& d, const core::FieldNumber& n) {
  return d.field == "/trace/digest" ? fmt::format("{:#018x}", n.bits) : n.text();
}

std::string contact_text(const core::Contact& c) {
  return fmt::format(
      "{} on {}: depth {:.4g} m, normal {:.3g} {:.3g} {:.3g}, normal impulse {:.4g} N s, tangent impulse {:.4g} N s",
      validation::body_text(c.a), validation::body_text(c.b), c.depth_m, c.normal.x, c.normal.y, c.normal.z,
      c.normal_impulse_n_s, c.tangent_impulse_n_s);
}

std::string point_text(const core::ContactPoint& p) {
  return fmt::format(
      "{} on {}: at {:.4g} {:.4g} {:.4g} m, gap {:.4g} m, normal {:.3g} {:.3g} {:.3g}, impulse {:.4g} {:.4g} {:.4g} N "
      "s",
      validation::body_text(p.a), validation::body_text(p.b), p.point.x, p.point.y, p.point.z, p.gap_m, p.normal.x,
      p.normal.y, p.normal.z, p.impulse.x, p.impulse.y, p.impulse.z);
}

std::string first_text(const TraceDifference& t) {
  const FrameDifference& d = *t.first;
  std::string text = fmt::format("\nFirst difference: step {}", t.step);
  if (d.body_count > 0) text += ", " + bodies_text(d);
  text += ", " + field_text(d);
  if (d.field.starts_with("/trace/contact")) text += fmt::format(" (contact {} of the step)", d.record);
  if (d.field.starts_with("/trace/point")) text += fmt::format(" (point {} of the step)", d.record);
  text += "\n";
  if (d.kind != DifferenceKind::kValue) return text + "  " + kind_text(d) + "\n";
  return text + fmt::format("  A  {}\n  B  {}\n  {}\n", number_text(d, d.a), number_text(d, d.b), distance_text(d));
}

// Contacts or points of the bodies, step by step.
template <typename Item, typename Text>
std::string items_text(const TraceDifference& t, const std::vector<Item>& items, std::string_view what, Text text_of) {
  std::string before;
  std::string at;
  for (const Item& item : items) {
    if (item.step < t.step)
      before += fmt::format("  step {}: {}\n", item.step, text_of(item));
    else
      at += fmt::format("  {}: {}\n", item.is_of_b ? "B" : "A", text_of(item));
  }
  return fmt::format("\n{} of {} in the ten recorded steps before:\n{}In step {}:\n{}", what, bodies_text(*t.first),
                     before.empty() ? "  none\n" : before, t.step, at.empty() ? "  none\n" : at);
}

std::string history_text(const TraceDifference& t) {
  if (t.first->body_count == 0) return "";
  std::string text;
  if (t.has_history)
    text += items_text(t, t.history, "Contacts", [](const HistoryContact& h) { return contact_text(h.contact); });
  if (t.has_points)
    text += items_text(t, t.points, "Points", [](const HistoryPoint& h) { return point_text(h.point); });
  if (!text.empty()) return text;
  return fmt::format("\nContacts of {} before: A records none.\n", bodies_text(*t.first));
}

std::string summary_text(const TraceDifference& t) {
  std::string text = fmt::format("Compared: {}\n", joined(t.groups).empty() ? "digests" : joined(t.groups));
  if (!t.groups_only_in_a.empty()) text += fmt::format("Only in A: {}\n", joined(t.groups_only_in_a));
  if (!t.groups_only_in_b.empty()) text += fmt::format("Only in B: {}\n", joined(t.groups_only_in_b));
  if (t.is_narrowed) text += "States: only one trace has them in float64, so both are compared as float32\n";
  for (const DeclaredDifference& d : t.declared)
    text += fmt::format("Declarations differ: {}: A {}, B {}\n", d.key, d.a, d.b);
  text += t.first ? fmt::format("{} steps in both; {} are the same before the first difference\n", t.common_steps,
                                t.equal_steps)
                  : fmt::format("{} steps in both, and no difference in any\n", t.common_steps);
  if (t.only_in_a > 0) text += fmt::format("{} steps are only in A\n", t.only_in_a);
  if (t.only_in_b > 0) text += fmt::format("{} steps are only in B\n", t.only_in_b);
  if (t.has_digests && t.other_digests > 0)
    text += fmt::format("{} of the {} steps have different digests\n", t.other_digests, t.common_steps);
  return text;
}

nlohmann::ordered_json contact_json(const HistoryContact& h) {
  const core::Contact& c = h.contact;
  const auto real = [](float v) { return fmt::format("{:.9g}", v); };
  return {{"step", h.step},
          {"trace", h.is_of_b ? "B" : "A"},
          {"a", c.a},
          {"b", c.b},
          {"color", c.color},
          {"depth_m", real(c.depth_m)},
          {"normal", {real(c.normal.x), real(c.normal.y), real(c.normal.z)}},
          {"normal_impulse_n_s", real(c.normal_impulse_n_s)},
          {"tangent_impulse_n_s", real(c.tangent_impulse_n_s)}};
}

nlohmann::ordered_json point_json(const HistoryPoint& h) {
  const core::ContactPoint& p = h.point;
  const auto real = [](float v) { return fmt::format("{:.9g}", v); };
  const auto vector = [&](core::Vec3 v) { return nlohmann::ordered_json{real(v.x), real(v.y), real(v.z)}; };
  return {{"step", h.step},
          {"trace", h.is_of_b ? "B" : "A"},
          {"a", p.a},
          {"b", p.b},
          {"point_m", vector(p.point)},
          {"normal", vector(p.normal)},
          {"gap_m", real(p.gap_m)},
          {"impulse_n_s", vector(p.impulse)}};
}

nlohmann::ordered_json first_json(const TraceDifference& t) {
  const FrameDifference& d = *t.first;
  nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
  for (std::uint32_t k = 0; k < d.body_count; ++k) bodies.push_back(d.bodies[k]);
  nlohmann::ordered_json out{
      {"step", t.step}, {"kind", kind_text(d)}, {"field", d.field}, {"record", d.record}, {"bodies", bodies}};
  if (d.kind != DifferenceKind::kValue) return out;
  out["element"] = d.element_name();
  out["a"] = number_text(d, d.a);
  out["b"] = number_text(d, d.b);
  const std::uint64_t ulps = core::ulps_between(d.a, d.b);
  if (is_real(d) && ulps != core::kNoUlps) out["ulps"] = ulps;
  return out;
}

nlohmann::ordered_json side_json(const core::TraceReader& trace) {
  return {{"file", trace.path().string()}, {"label", trace.header().stamp.label()}};
}

}  // namespace

std::string difference_text(const core::TraceReader& a, const core::TraceReader& b, const TraceDifference& difference) {
  std::string text = fmt::format("A  {}  {}\nB  {}  {}\n", a.path().string(), a.header().stamp.label(),
                                 b.path().string(), b.header().stamp.label());
  text += summary_text(difference);
  if (difference.first) text += first_text(difference) + history_text(difference);
  return text;
}

std::string difference_json(const core::TraceReader& a, const core::TraceReader& b, const TraceDifference& difference) {
  const TraceDifference& t = difference;
  nlohmann::ordered_json out{{"same", t.is_same()},
                             {"a", side_json(a)},
                             {"b", side_json(b)},
                             {"compared", t.groups},
                             {"steps_in_both", t.common_steps},
                             {"steps_equal", t.equal_steps},
                             {"steps_only_in_a", t.only_in_a},
                             {"steps_only_in_b", t.only_in_b}};
  if (t.is_narrowed) out["compared_as"] = "float32";
  if (!t.declared.empty()) {
    out["declared_otherwise"] = nlohmann::ordered_json::object();
    for (const DeclaredDifference& d : t.declared) out["declared_otherwise"][d.key] = {{"a", d.a}, {"b", d.b}};
  }
  if (t.has_digests) out["steps_with_another_digest"] = t.other_digests;
  if (t.first) out["first"] = first_json(t);
  if (t.first && t.has_history) {
    out["history"] = nlohmann::ordered_json::array();
    for (const HistoryContact& h : t.history) out["history"].push_back(contact_json(h));
  }
  if (t.first && t.has_points) {
    out["points"] = nlohmann::ordered_json::array();
    for (const HistoryPoint& h : t.points) out["points"].push_back(point_json(h));
  }
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace broadside::bench
