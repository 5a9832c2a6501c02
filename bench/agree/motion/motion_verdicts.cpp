#include "bench/agree/motion/motion_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/agree/pairs.hpp"

namespace broadside::bench {
namespace {

void add(MotionBin& bin, const MotionTest& test, const MotionAnswer& answer, MotionVerdict verdict) {
  ++bin.count[static_cast<std::size_t>(verdict)];
  if (answer.asked != Asked::kAnswered || !answer.follows) return;
  bin.seconds.push_back(answer.seconds);
  const bool is_judged =
      verdict == MotionVerdict::kAgree || verdict == MotionVerdict::kEarly || verdict == MotionVerdict::kLate;
  if (!is_judged || test.truth.kind != MotionTruth::Kind::kTouch) return;
  if (answer.found.time > test.truth.upper)
    bin.late.push_back(answer.found.time - test.truth.upper);
  else
    bin.early.push_back(std::max(0.0, test.truth.lower - answer.found.time));
}

}  // namespace

std::uint64_t MotionBin::tests() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : count) sum += n;
  return sum;
}

std::uint64_t MotionBin::touches() const {
  return early.size() + late.size() + of(MotionVerdict::kMissed);
}

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

MotionVerdict judge(const MotionTest& test, const MotionAnswer& answer, double late_band, double early_band) {
  switch (answer.asked) {
    case Asked::kThrew:
      return MotionVerdict::kThrew;
    case Asked::kAborted:
      return MotionVerdict::kAborted;
    case Asked::kTimedOut:
      return MotionVerdict::kTimedOut;
    case Asked::kCrashed:
    case Asked::kNothing:
      return MotionVerdict::kCrashed;
    case Asked::kAnswered:
      break;
  }
  if (!answer.follows) return MotionVerdict::kOtherPath;
  const double time = answer.found.time;
  if (answer.found.touches && !(time >= 0.0 && time <= 1.0)) return MotionVerdict::kNoNumber;
  if (test.truth.rounding_decides) return MotionVerdict::kRounded;
  switch (test.truth.kind) {
    case MotionTruth::Kind::kUndecided:
      return MotionVerdict::kUndecided;
    case MotionTruth::Kind::kApart:
      return answer.found.touches ? MotionVerdict::kFalse : MotionVerdict::kAgree;
    case MotionTruth::Kind::kTouch:
      break;
  }
  if (!answer.found.touches) return MotionVerdict::kMissed;
  if (time > test.truth.upper + late_band) return MotionVerdict::kLate;
  return time < test.truth.lower - early_band ? MotionVerdict::kEarly : MotionVerdict::kAgree;
}

MotionTable tabulate(MotionKind kind, const std::vector<MotionTest>& tests, const std::vector<MotionAnswer>& answers,
                     const std::vector<double>& reach_m) {
  MotionTable table;
  table.by_family.resize(families_of(kind).size());
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const MotionTest& test = tests[k];
    double late_band = 0.0;
    double early_band = kEarlyFeatures;
    if (!is_of_features(kind)) {
      const double speed = relative_speed_m(test, reach_m[test.a.mesh], reach_m[test.b.mesh]);
      late_band = early_band = speed > 0.0 ? kTouchingBand_m / speed : 1.0;
    }
    const MotionVerdict verdict = judge(test, answers[k], late_band, early_band);
    table.verdicts.push_back(verdict);
    add(table.all, test, answers[k], verdict);
    add(table.by_family[test.family], test, answers[k], verdict);
  }
  return table;
}

}  // namespace broadside::bench
