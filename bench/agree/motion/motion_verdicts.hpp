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
  kLate,       // after it: they are in each other by then
  kMissed,     // no touch where there is one
  kFalse,      // a touch where there is none
  kUndecided,  // they come so near that the arbiter does not decide
  kRounded,    // the doubles that the engine got touch, and the fractions do not, or the other way round
  kOtherPath,  // the engine moves bodies along another path, and was not asked
  kNoNumber,   // a time that is NaN or outside of 0 to 1
  kThrew,
  kAborted,
  kCrashed,
  kTimedOut,
};
inline constexpr std::array<std::string_view, 13> kMotionVerdicts{
    "agree",      "early",     "late",      "missed", "false", "undecided", "decided by rounding",
    "other path", "no number", "exception", "abort",  "crash", "time-out"};

// Of the step: how much earlier than the touch an answer may be, of features. The bar of our own engine.
inline constexpr double kEarlyFeatures = 1e-6;
// Of the answers of engines of features none may be late. Bodies may have moved by the touching band of 1e-4 m
// (bench/agree/pairs.hpp) in between, before the touch and after it.

// band: time in which the bodies move by the touching band; of features 0.
MotionVerdict judge(const MotionTest& test, const MotionAnswer& answer, double late_band, double early_band);

struct MotionBin {
  std::array<std::uint64_t, kMotionVerdicts.size()> count{};
  std::vector<double> early;  // of answers that are not late, in units of the step
  std::vector<double> late;   // of those that are after the touch at all, whatever the verdict
  std::vector<float> seconds;

  [[nodiscard]] std::uint64_t tests() const;
  [[nodiscard]] std::uint64_t of(MotionVerdict verdict) const { return count[static_cast<std::size_t>(verdict)]; }
  [[nodiscard]] std::uint64_t touches() const;  // that were asked and judged
};
double median_of(std::vector<double> values);  // NaN of none

struct MotionTable {
  MotionBin all;
  std::vector<MotionBin> by_family;
  std::vector<MotionVerdict> verdicts;  // one a test
};

// reach_m: of each mesh; none for features.
MotionTable tabulate(MotionKind kind, const std::vector<MotionTest>& tests, const std::vector<MotionAnswer>& answers,
                     const std::vector<double>& reach_m);

}  // namespace broadside::bench
