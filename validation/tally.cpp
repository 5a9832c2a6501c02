#include "validation/tally.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "core/contact.hpp"

namespace broadside::validation {
namespace {

double ratio_of(double measured, double limit) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  if (std::isnan(measured)) return kInf;
  if (measured <= 0.0) return 0.0;
  return limit > 0.0 ? measured / limit : kInf;
}

std::string where_text(const Where& where) {
  std::string text = "step " + std::to_string(where.step);
  for (std::uint32_t k = 0; k < where.body_count; ++k) text += (k == 0 ? ", " : " and ") + body_text(where.bodies[k]);
  if (!where.field.empty()) text += ", " + std::string(where.field);
  return text;
}

}  // namespace

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string body_text(std::uint32_t body) {
  static constexpr const char* kFaces[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
  if (!core::is_face(body)) return "body " + std::to_string(body);
  const std::uint32_t face = body - core::kFirstFace;
  return face < core::kFaceCount ? std::string("the ") + kFaces[face] + " face" : "unknown face";
}

bool Tally::check(double measured, const Limit& limit, const Where& where, const std::function<std::string()>& worked) {
  ++checked_;
  const bool holds = measured <= limit.value;
  if (!holds && violations_++ == 0) first_violation_ = where;
  // A value that breaks its limit always outranks one that holds, also when the limit is NaN.
  double ratio = ratio_of(measured, limit.value);
  if (!holds && !(ratio > 1.0)) ratio = std::numeric_limits<double>::infinity();
  if (ratio > worst_ratio_) {
    worst_ratio_ = ratio;
    worst_measured_ = measured;
    worst_limit_ = limit;
    worst_where_ = where;
    // Only a failing verdict shows them.
    if (!holds) worst_worked_ = worked ? worked() : std::string();
  }
  return holds;
}

bool Tally::require(bool holds, std::string_view origin, const Where& where) {
  return check(holds ? 0.0 : 1.0, {0.0, "violations", origin}, where);
}

void Tally::absorb(const Tally& other) {
  checked_ += other.checked_;
  undecided_ += other.undecided_;
  moved_ += other.moved_;
  if (other.violations_ > 0 && (violations_ == 0 || other.first_violation_.step < first_violation_.step))
    first_violation_ = other.first_violation_;
  violations_ += other.violations_;
  const bool is_worse = other.worst_ratio_ > worst_ratio_;
  const bool is_earlier = other.worst_ratio_ == worst_ratio_ && other.worst_where_.step < worst_where_.step;
  if (!is_worse && !is_earlier) return;
  worst_ratio_ = other.worst_ratio_;
  worst_measured_ = other.worst_measured_;
  worst_limit_ = other.worst_limit_;
  worst_where_ = other.worst_where_;
  worst_worked_ = other.worst_worked_;
}

bool Tally::check_bound(double bound, double limit) {
  if (!(bound <= limit) || ratio_of(bound, limit) > worst_ratio_) return false;
  ++checked_;
  return true;
}

core::Verdict Tally::conclude(std::string_view nothing, const std::string& notes) const {
  core::Verdict verdict;
  verdict.validator = validator_;
  verdict.origin = origin_;
  verdict.checked = checked_;
  verdict.violations = violations_;
  verdict.moved = moved_;
  const std::string tail = notes.empty() ? "" : "; " + notes;
  if (checked_ == 0) {
    verdict.outcome = undecided_ > 0 ? core::Outcome::kInconclusive : core::Outcome::kNotApplicable;
    verdict.explanation = undecided_ > 0 ? "rounding alone decides all " + std::to_string(undecided_) + " " +
                                               std::string(things_) + " that were met"
                                         : std::string(nothing);
    return verdict;
  }
  verdict.measured = worst_measured_;
  verdict.limit = worst_limit_.value;
  verdict.unit = worst_limit_.unit;
  // When nothing stood out, the law's own origin says more than the origin of the first limit.
  if (worst_ratio_ > 0.0 && !worst_limit_.origin.empty()) verdict.origin = worst_limit_.origin;
  verdict.worst.step = static_cast<std::int64_t>(worst_where_.step);
  verdict.worst.bodies.assign(worst_where_.bodies, worst_where_.bodies + worst_where_.body_count);
  verdict.worst.field = worst_where_.field;
  if (violations_ > 0) {
    verdict.outcome = core::Outcome::kFail;
    const bool began_before = first_violation_.step < worst_where_.step;
    verdict.explanation = std::to_string(violations_) + " of " + std::to_string(checked_) + " " + std::string(things_) +
                          " break the law, " + (began_before ? "first at " + where_text(first_violation_) + ", " : "") +
                          "worst at " + where_text(worst_where_) + ": " + number_text(worst_measured_) + " where " +
                          number_text(worst_limit_.value) + " " + std::string(worst_limit_.unit) + " is allowed";
    if (!worst_worked_.empty()) verdict.explanation += ": " + worst_worked_;
  } else {
    verdict.outcome = core::Outcome::kPass;
    verdict.explanation = std::to_string(checked_) + " " + std::string(things_) + " hold";
  }
  if (undecided_ > 0)
    verdict.explanation += ", " + std::to_string(undecided_) + " left undecided inside the rounding band";
  verdict.explanation += tail;
  return verdict;
}

}  // namespace broadside::validation
