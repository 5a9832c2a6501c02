// Where a series of measurements changed for good: E-divisive with a t-test.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace broadside::reports {

struct ChangePoint {
  std::size_t index = 0;  // first value of the new regime
  double before = 0.0;    // means of the regimes on both sides
  double after = 0.0;
  double p = 1.0;  // of Welch's test between the two regimes
};

struct ChangePointOptions {
  // The largest p of a change that is reported. A nightly history tests every place of every series again each night,
  // so the usual 5 % would give false alarms every week; Fleming and others use 0.1 % for the same purpose (ICPE 2023).
  double most_p = 0.001;
  std::size_t least_values = 3;  // of a regime; fewer have no spread worth testing
};

// Splits where the energy statistic of Matteson and James (2014; exponent 1) is largest, tests the split with Welch's
// t-test instead of permutations (Fleming et al. 2023), so that the answer is the same every time, and continues on
// both sides. Then it removes, weakest first, the change points that are not significant between their neighbors.
// Rising by index. Values are finite. O(n^2) a split.
std::vector<ChangePoint> change_points(std::span<const double> values, const ChangePointOptions& options = {});

// Two-sided p of Welch's t-test for equal means of two sets; 1 where a set has fewer than two values. Two sets without
// spread give 1 when they are equal, and 0 otherwise.
double welch_p(std::span<const double> a, std::span<const double> b);

// P(|T| > t) of Student's distribution with `degrees` > 0 degrees of freedom, t >= 0.
double student_two_sided(double t, double degrees);

}  // namespace broadside::reports
