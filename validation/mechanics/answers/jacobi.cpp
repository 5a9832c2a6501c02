#include "validation/mechanics/answers/jacobi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace broadside::validation {
namespace {

// R_F(x, y, z): relative error below 1e-16 when the spread is below 1e-3, since the series stops at its sixth power.
double carlson_rf(double x, double y, double z) {
  for (;;) {
    const double mean = (x + y + z) / 3.0;
    const double dx = 1.0 - x / mean;
    const double dy = 1.0 - y / mean;
    const double dz = 1.0 - z / mean;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < 1e-3) {
      const double e2 = dx * dy - dz * dz;
      const double e3 = dx * dy * dz;
      return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / std::sqrt(mean);
    }
    const double shift = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
  }
}

}  // namespace

double quarter_period(double m) {
  double a = 1.0;
  double b = std::sqrt(1.0 - m);
  while (std::abs(a - b) > 1e-15 * a) {
    const double next = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = next;
  }
  return std::numbers::pi / (a + b);
}

Jacobi jacobi(double u, double m) {
  // Means until the differences vanish; they do so quadratically, and 12 steps reach any m below 1.
  std::array<double, 16> a{1.0};
  std::array<double, 16> c{std::sqrt(m)};
  double b = std::sqrt(1.0 - m);
  std::size_t n = 0;
  while (n + 1 < a.size() && std::abs(c[n]) > 1e-16) {
    a[n + 1] = 0.5 * (a[n] + b);
    c[n + 1] = 0.5 * (a[n] - b);
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, static_cast<int>(n));
  for (; n > 0; --n) phi = 0.5 * (phi + std::asin(std::clamp(c[n] / a[n] * std::sin(phi), -1.0, 1.0)));
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1.0 - m * sn * sn)};
}

double elliptic_f(double phi, double m) {
  const double turns = std::round(phi / std::numbers::pi);
  const double rest = phi - turns * std::numbers::pi;
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  return 2.0 * turns * quarter_period(m) + s * carlson_rf(c * c, 1.0 - m * s * s, 1.0);
}

}  // namespace broadside::validation
