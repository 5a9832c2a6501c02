// How an engine's first touch compares with the arbiter's bracket, and sums of these verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "bench/agree/motion/motion_answers.hpp"

namespace broadside::bench {

enum class MotionVerdict {
  kAgree,
  kEarly,      // before the touch, by more than is allowed
  kLate,       // after the touch: by then the bodies overlap
  kMissed,     // no touch where there is one
  kFalse,      // a touch where there is none
  kUndecided,  // the bodies come so near that the arbiter does not decide
  kRounded,    // the doubles that the engine got touch and the fractions do not, or the reverse
  kOtherPath,  // the engine moves bodies along another path, so it was not asked
  kNoNumber,   // a time that is NaN or outside of 0 to 1
  kThrew,
  kAborted,
  kCrashed,
  kTimedOut,
};
inline constexpr std::array<std::string_view, 13> kMotionVerdicts{
    "agree",      "early",     "late",      "missed", "false", "undecided", "decided by rounding",
    "other path", "no number", "exception", "abort",  "crash", "time-out"};

// How much earlier than the touch an answer about features may be, as a share of the step. Our own engine is held to
// it.
inline constexpr double kEarlyFeatures = 1e-6;
// Answers about features may not be late at all. Answers about bodies may be early or late by the time in which the
// bodies move by the touching band of 1e-4 m (bench/agree/pairs.hpp).

// The bands are times: how long the bodies take to move by the touching band. For features late_band is 0.
MotionVerdict judge(const MotionTest& test, const MotionAnswer& answer, double late_band, double early_band);

struct MotionBin {
  std::array<std::uint64_t, kMotionVerdicts.size()> count{};
  std::vector<double> early;  // of answers that are not late, in units of the step
  std::vector<double> late;   // of answers after the touch, whatever the verdict
  std::vector<float> seconds;

  [[nodiscard]] std::uint64_t tests() const;
  [[nodiscard]] std::uint64_t of(MotionVerdict verdict) const { return count[static_cast<std::size_t>(verdict)]; }
  [[nodiscard]] std::uint64_t touches() const;  // tests with a touch that were asked and judged
};
double median_of(std::vector<double> values);  // NaN when there are none

struct MotionTable {
  MotionBin all;
  std::vector<MotionBin> by_family;
  std::vector<MotionVerdict> verdicts;  // one for each test
};

// reach_m: one for each mesh; empty for features.
MotionTable tabulate(MotionKind kind, const std::vector<MotionTest>& tests, const std::vector<MotionAnswer>& answers,
                     const std::vector<double>& reach_m);

}  // namespace broadside::bench
