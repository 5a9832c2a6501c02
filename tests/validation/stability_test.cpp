// METHOD 1's step limit against the eigenvalues of the recurrence, and the bound of its powers.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/method/integrate.hpp"
#include "validation/spring_motion.hpp"

namespace broadside::tests {
namespace {

// Largest |lambda| of v' = v - h (w0^2 y + g v), y' = y + h v': lambda^2 - (2 - h g - h^2 w0^2) lambda + (1 - h g) = 0.
double spectral_radius(double w0, double g, double h) {
  const std::complex<double> trace = 2.0 - h * g - h * h * w0 * w0;
  const std::complex<double> root = std::sqrt(trace * trace - 4.0 * (1.0 - h * g));
  return std::max(std::abs(0.5 * (trace + root)), std::abs(0.5 * (trace - root)));
}

TEST(StepLimit, IsWhereTheRecurrenceStopsContracting) {
  for (const double w0 : {0.5, 1.0, 60.0})
    for (const double g : {0.0, 0.1, 2.0, 50.0}) {
      const double limit = core::step_limit_sound(w0, g);
      EXPECT_LE(spectral_radius(w0, g, 0.999 * limit), 1.0 + 1e-12) << w0 << " " << g;
      EXPECT_GT(spectral_radius(w0, g, 1.001 * limit), 1.0) << w0 << " " << g;
      validation::Oscillator o;
      o.w = 1.0;
      o.stiffness = w0 * w0;
      o.damping = g;
      EXPECT_DOUBLE_EQ(o.step_limit(), limit);
    }
}

// The figures of METHOD 1.
TEST(StepLimit, PrintedIsTooLargeOnceThereIsDamping) {
  EXPECT_DOUBLE_EQ(core::step_limit_printed(3.0, 0.0), core::step_limit_sound(3.0, 0.0));
  EXPECT_NEAR(spectral_radius(1.0, 2.0, 0.999 * core::step_limit_printed(1.0, 2.0)), 3.36, 0.005);
  EXPECT_GT(core::step_limit_printed(1.0, 2.0), core::step_limit_sound(1.0, 2.0));
}

// Undamped, the recurrence keeps v^2 + w0^2 y^2 - h w0^2 y v, an ellipse with the axes 1 -+ r, where r = h w0 / 2. So
// powers stay below sqrt((1 + r) / (1 - r)), and come near that bound where the rotation is no simple fraction of a
// turn.
TEST(StepPowers, StayBelowTheConservedFormsBound) {
  for (const double r : {0.1, 0.3, 0.99}) {
    validation::StepPowers powers(1.0, 0.0, 2.0 * r);
    for (int k = 0; k < 20000; ++k) powers.advance();
    const double bound = std::sqrt((1.0 + r) / (1.0 - r));
    EXPECT_LE(powers.largest_norm(), bound * (1.0 + 1e-9));
    EXPECT_GE(powers.largest_norm(), 0.99 * bound);
  }
  validation::StepPowers unstable(1.0, 2.0, 1.0);
  for (int k = 0; k < 100; ++k) unstable.advance();
  EXPECT_GT(unstable.largest_norm(), 1e10);
}

}  // namespace
}  // namespace broadside::tests
