#include "bench/agree/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/vendor_defects.hpp"

namespace broadside::bench {
namespace {

using exact::Point;

bool is_zero(core::Vec3 v) {
  return v == core::Vec3{};
}

bool is_number(const core::Separation& s) {
  return std::isfinite(s.distance_m) && std::isfinite(s.normal.x) && std::isfinite(s.normal.y) &&
         std::isfinite(s.normal.z);
}

// Between the answer's normal and the arbiter's, rad.
double angle_between(core::Vec3 n, Point truth) {
  const Point p = exact::to_point(n);
  const Point c = cross(p, truth);
  return std::atan2(std::sqrt(dot(c, c)), dot(p, truth));
}

// A wrong direction is judged by how much it underestimates the gap: bodies at distance d are at least d cos(t) apart
// along a direction that is off by t. For convex bodies the gap along a direction is computed; for meshes the angle
// bounds it.
bool shows_the_gap(const PairSource& source, const TestPair& pair, Point n) {
  const double least = pair.distance_m - kTouchingBand_m;
  if (source.has_depth()) return -source.overlap_along(pair, n) >= least;
  return pair.distance_m * dot(n, pair.normal) >= least;
}

Agreement judge_apart(const PairSource& source, const TestPair& pair, const core::Separation& s) {
  if (s.is_touching) return Agreement::kExtra;
  if (std::isnan(s.distance_m)) return Agreement::kAgree;  // an engine that gives no distance is right with the flag
  if (!is_number(s)) return Agreement::kNoNumber;
  if (std::abs(s.distance_m - pair.distance_m) > kTouchingBand_m) return Agreement::kDistanceOff;
  if (is_zero(s.normal)) return Agreement::kAgree;
  const Point n = exact::to_point(s.normal);
  if (shows_the_gap(source, pair, n)) return Agreement::kAgree;
  return shows_the_gap(source, pair, -1.0 * n) ? Agreement::kConvention : Agreement::kNormalOff;
}

Agreement judge_overlap(const PairSource& source, const TestPair& pair, const core::Separation& s) {
  if (!s.is_touching) return std::isnan(s.normal.x) ? Agreement::kNoNumber : Agreement::kMissed;
  if (!source.has_depth()) return Agreement::kAgree;
  if (!is_number(s) || is_zero(s.normal)) return Agreement::kNoNumber;
  if (std::abs(s.distance_m - pair.distance_m) > kTouchingBand_m) return Agreement::kDepthOff;
  // Several directions may be equally short; any of them is right.
  const Point n = exact::to_point(s.normal);
  const double most = -pair.distance_m + kTouchingBand_m;
  if (source.overlap_along(pair, n) <= most) return Agreement::kAgree;
  return source.overlap_along(pair, -1.0 * n) <= most ? Agreement::kConvention : Agreement::kNormalOff;
}

int decade(double value, int lowest, int count) {
  if (!(value > 0.0)) return 0;
  return std::clamp(static_cast<int>(std::floor(std::log10(value))) - lowest + 1, 0, count - 1);
}

void add(AgreementBin& bin, const TestPair& pair, const PairAnswer& answer, Agreement verdict) {
  ++bin.count[static_cast<std::size_t>(verdict)];
  if (answer.asked != Asked::kAnswered) return;
  bin.seconds.push_back(answer.seconds);
  const core::Separation& s = answer.separation;
  if (!is_number(s)) return;
  ++bin.error[static_cast<std::size_t>(decade(std::abs(s.distance_m - pair.distance_m), -8, kErrorDecades))];
  const bool has_direction = dot(pair.normal, pair.normal) > 0.0 && !is_zero(s.normal);
  if (has_direction)
    ++bin.angle[static_cast<std::size_t>(decade(angle_between(s.normal, pair.normal), -6, kAngleDecades))];
}

}  // namespace

std::uint64_t AgreementBin::pairs() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : count) sum += n;
  return sum;
}

double AgreementBin::median_s() const {
  if (seconds.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<float> sorted = seconds;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  return sorted[sorted.size() / 2];
}

Agreement judge(const PairSource& source, const TestPair& pair, const PairAnswer& answer) {
  switch (answer.asked) {
    case Asked::kThrew:
      return Agreement::kThrew;
    case Asked::kAborted:
      return Agreement::kAborted;
    case Asked::kTimedOut:
      return Agreement::kTimedOut;
    case Asked::kCrashed:
    case Asked::kNothing:
      return Agreement::kCrashed;
    case Asked::kAnswered:
      break;
  }
  const core::Separation& s = answer.separation;
  if (pair.separation == Separated::kTouching)
    return s.is_touching && !is_number(s) ? Agreement::kNoNumber : Agreement::kTouchingBand;
  return pair.distance_m > kTouchingBand_m ? judge_apart(source, pair, s) : judge_overlap(source, pair, s);
}

AgreementTable tabulate(const PairSource& source, const std::vector<TestPair>& pairs,
                        const std::vector<PairAnswer>& answers, std::vector<Agreement>& verdicts) {
  AgreementTable table;
  verdicts.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Agreement verdict = judge(source, pairs[k], answers[k]);
    verdicts.push_back(verdict);
    add(table.by_separation[static_cast<std::size_t>(pairs[k].separation)], pairs[k], answers[k], verdict);
    add(table.by_degeneracy[static_cast<std::size_t>(pairs[k].degeneracy)], pairs[k], answers[k], verdict);
  }
  return table;
}

std::vector<core::DefectHits> defects_met(std::string_view engine_label, PairKind kind,
                                          const std::vector<Agreement>& verdicts) {
  using reference::Defect;
  std::vector<core::DefectHits> met;
  const auto report = [&](Defect defect, Agreement verdict) {
    reference::DefectCounter counter(defect);
    counter.note(static_cast<std::uint64_t>(std::count(verdicts.begin(), verdicts.end(), verdict)), verdicts.size());
    met.push_back(counter.hits());
  };
  if (engine_label.starts_with("fcl")) {
    report(Defect::kFclAbort, Agreement::kAborted);
    report(Defect::kFclThrow, Agreement::kThrew);
    report(Defect::kFclHang, Agreement::kTimedOut);
    const bool is_collide = engine_label.find("query=collide") != std::string_view::npos;
    if (kind == PairKind::kBoxes && is_collide) report(Defect::kFclBoxAxis, Agreement::kDepthOff);
    if (kind == PairKind::kConvex) report(Defect::kFclConvexNormal, Agreement::kDepthOff);
  }
  if (engine_label.starts_with("bullet-shapes") && kind != PairKind::kKissing)
    report(Defect::kBulletNearNormal, Agreement::kNormalOff);
  if (engine_label.starts_with("ccd")) {
    const bool is_mpr = engine_label.find("algorithm=mpr") != std::string_view::npos;
    if (is_mpr) report(Defect::kCcdMprDepth, Agreement::kDepthOff);
    if (!is_mpr) report(Defect::kCcdGjkNan, Agreement::kNoNumber);
    if (!is_mpr) report(Defect::kCcdEpaHang, Agreement::kTimedOut);
  }
  return met;
}

std::string agreement_text(const AgreementBin& bin) {
  std::string text;
  for (std::size_t k = 0; k < kAgreements.size(); ++k)
    if (bin.count[k] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", bin.count[k], kAgreements[k]);
  if (text.empty()) return "no pairs";
  const double median = bin.median_s();
  return std::isnan(median) ? text : text + fmt::format("; median {:.3g} us", 1e6 * median);
}

}  // namespace broadside::bench
