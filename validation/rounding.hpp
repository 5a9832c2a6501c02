// The rounding model that limits are derived from: float32 arithmetic of the engines, seen from float64.
#pragma once

namespace broadside::validation {

// Unit roundoff of float32: one rounded operation has a relative error of at most this (round to nearest, IEEE 754).
constexpr double kUnitRoundoff = 0x1p-24;

// Largest absolute error of one operation whose result is subnormal. Limits that would be exactly zero at zero
// magnitude add it.
constexpr double kSubnormal = 0x1p-149;

// Relative error of a chain of `operations` rounded operations without cancellation: n u / (1 - n u). Higham, Accuracy
// and Stability of Numerical Algorithms (2002), section 3.1.
constexpr double rounding(int operations) {
  return operations * kUnitRoundoff / (1.0 - operations * kUnitRoundoff);
}

}  // namespace broadside::validation
