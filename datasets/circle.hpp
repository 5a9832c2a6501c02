// Cosines and sines with the same bits on every machine: scenes contain directions, and libraries differ in the last
// digit.
#pragma once

#include <cstdint>

namespace broadside::datasets {

struct Turn {
  double cosine = 1.0;
  double sine = 0.0;
};

// Cosine and sine of an angle in rad, |angle| <= pi, by the power series; 16 terms reach the rounding of double there.
constexpr Turn turn_by(double angle_rad) {
  Turn t;
  const double square = angle_rad * angle_rad;
  double even = 1.0;
  double odd = angle_rad;
  t.sine = odd;
  for (int k = 1; k <= 16; ++k) {
    even = -even * square / ((2.0 * k - 1.0) * (2.0 * k));
    odd = -odd * square / ((2.0 * k) * (2.0 * k + 1.0));
    t.cosine += even;
    t.sine += odd;
  }
  return t;
}

// Cosine and sine of k / n of the full circle, k < n. Quarters are exact.
constexpr Turn part_of_circle(std::uint32_t k, std::uint32_t n) {
  constexpr double kPi = 3.14159265358979323846;
  const std::uint32_t quarter = 4 * k / n;
  // The rest of the angle within its quarter, below pi / 2.
  const Turn t = turn_by(2.0 * kPi * (static_cast<double>(k) / n - 0.25 * quarter));
  switch (quarter) {
    case 1:
      return {-t.sine, t.cosine};
    case 2:
      return {-t.cosine, -t.sine};
    case 3:
      return {t.sine, -t.cosine};
    default:
      return t;
  }
}

}  // namespace broadside::datasets
