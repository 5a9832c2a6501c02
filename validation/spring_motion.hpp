// Springs on one body as one damped oscillator, in float64: its step limit and how far one step carries.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {

struct Oscillator {
  std::uint32_t body = 0;
  double w = 0.0;          // inverse mass, 1/kg
  double stiffness = 0.0;  // sum over its springs, N/m
  double damping = 0.0;    // N s/m
  Vec3d rest;              // where it would hang still, m; meaningful when stiffness > 0
  std::vector<core::Spring> springs;

  [[nodiscard]] double w0() const { return std::sqrt(stiffness * w); }
  [[nodiscard]] double g() const { return damping * w; }
  // METHOD 1's sound limit, s.
  [[nodiscard]] double step_limit() const;
  // sqrt(w0^2 |x - rest|^2 + |v|^2), m/s: the square root of 2 w times the oscillator's energy.
  [[nodiscard]] double amplitude(Vec3d x, Vec3d v) const;
};

// Rounded operations between dt A, A the sum of the magnitudes of all accelerations, and its addition to a velocity:
// the product with dt; and with springs the reach, its stiffness, the damping's subtraction, the inverse mass, and one
// sum a spring.
constexpr int acceleration_operations(std::size_t springs) {
  return springs == 0 ? 1 : 5 + static_cast<int>(springs);
}

// One per body that has springs with any stiffness or damping, by body.
std::vector<Oscillator> oscillators(const core::Scene& scene);

// The powers of the matrix of one step of semi-implicit Euler on (w0 y, v), and their spectral norms.
class StepPowers {
 public:
  StepPowers(double w0, double g, double dt);
  // Goes on to the next power.
  void advance();
  // The largest norm of the powers so far, the zeroth included: at least 1.
  [[nodiscard]] double largest_norm() const { return largest_; }
  // An upper bound of the exact largest norm: each advance rounds 3 operations an entry in double, no more than 2^-50
  // of what it multiplies, and later steps carry that on.
  [[nodiscard]] double bound() const { return largest_ * (1.0 + 0x1p-50 * steps_ * largest_); }

 private:
  double step_[4];
  double power_[4] = {1.0, 0.0, 0.0, 1.0};
  double largest_ = 1.0;
  double steps_ = 0.0;
};

}  // namespace broadside::validation
