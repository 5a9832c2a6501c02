// The free turning of a body by Jacobi's functions, against integration of Euler's equations and known figures.
#include "validation/mechanics/answers/free_turning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/mechanics/answers/jacobi.hpp"

namespace broadside::tests {
namespace {

using validation::FreeTurning;
using validation::Jacobi;
using validation::Mat3d;
using validation::Quatd;
using validation::Vec3d;

// Abramowitz and Stegun, table 17.1 and example: K at m = 0, 1/2 and 0.99.
TEST(Jacobi, QuarterPeriodsAreThoseOfTheTables) {
  EXPECT_NEAR(validation::quarter_period(0.0), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(validation::quarter_period(0.5), 1.854074677301372, 1e-14);
  EXPECT_NEAR(validation::quarter_period(0.99), 3.695637362989875, 1e-13);
}

// At m = 0 they are sine and cosine; sn(K) = 1; and F is the inverse of the amplitude, over several periods.
TEST(Jacobi, FunctionsAndTheirInverseAgree) {
  for (const double u : {-3.0, -0.5, 0.25, 2.0, 7.0}) {
    EXPECT_NEAR(validation::jacobi(u, 0.0).sn, std::sin(u), 1e-14);
    EXPECT_NEAR(validation::jacobi(u, 0.0).dn, 1.0, 1e-14);
  }
  for (const double m : {0.1, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(validation::jacobi(validation::quarter_period(m), m).sn, 1.0, 1e-12);
    for (const double phi : {-4.0, -1.0, 0.3, 1.5, 3.0, 6.0}) {
      const Jacobi f = validation::jacobi(validation::elliptic_f(phi, m), m);
      EXPECT_NEAR(f.sn, std::sin(phi), 1e-11) << m << " " << phi;
      EXPECT_NEAR(f.cn, std::cos(phi), 1e-11) << m << " " << phi;
      EXPECT_NEAR(f.dn, std::sqrt(1.0 - m * std::sin(phi) * std::sin(phi)), 1e-11);
    }
  }
}

struct State {
  Vec3d w;
  Quatd q;
};

// Euler's equations by the classical Runge-Kutta method: another way to the same motion.
State integrated(Vec3d moments, Vec3d w, Quatd q, double t, int steps) {
  const auto rate = [&](const State& s) {
    return State{
        {(moments.y - moments.z) * s.w.y * s.w.z / moments.x, (moments.z - moments.x) * s.w.z * s.w.x / moments.y,
         (moments.x - moments.y) * s.w.x * s.w.y / moments.z},
        s.q * Quatd{0.0, 0.5 * s.w.x, 0.5 * s.w.y, 0.5 * s.w.z}};
  };
  const auto plus = [](const State& s, const State& d, double h) {
    return State{s.w + h * d.w, {s.q.w + h * d.q.w, s.q.x + h * d.q.x, s.q.y + h * d.q.y, s.q.z + h * d.q.z}};
  };
  State s{w, q};
  const double h = t / steps;
  for (int k = 0; k < steps; ++k) {
    const State a = rate(s);
    const State b = rate(plus(s, a, 0.5 * h));
    const State c = rate(plus(s, b, 0.5 * h));
    const State d = rate(plus(s, c, h));
    s = plus(plus(plus(plus(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    s.q = normalized(s.q);
  }
  return s;
}

double largest_difference(const Mat3d& a, const Mat3d& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, length(a.row[k] - b.row[k]));
  return most;
}

constexpr Vec3d kBrick{10.0 / 12.0 * (0.16 + 0.81), 10.0 / 12.0 * (0.01 + 0.81), 10.0 / 12.0 * (0.01 + 0.16)};
constexpr Vec3d kSpin{0.1, 5.0, 0.1};

// Period and angular velocity of the brick of 0.1 x 0.4 x 0.9 m that starts near its middle axis: known figures, found
// by integration elsewhere.
TEST(FreeTurning, TheBrickHasItsKnownFigures) {
  const FreeTurning brick(kBrick, kSpin, {});
  EXPECT_NEAR(brick.period_s(), 6.05684, 5e-6);
  EXPECT_GT(brick.angular_velocity(1.165).y, 0.0) << "it crosses zero at 1.165 s and some";
  EXPECT_LT(brick.angular_velocity(1.166).y, 0.0);
  const Vec3d w = brick.angular_velocity(10.0);
  EXPECT_NEAR(w.x, 2.755840, 1e-6);
  EXPECT_NEAR(w.y, -3.735964, 1e-6);
  EXPECT_NEAR(w.z, -3.161809, 1e-6);
}

// About each axis in turn, with either hand and both signs: every branch of the order of axes and of L^2 against 2 E
// I2.
TEST(FreeTurning, AgreesWithIntegrationForEveryOrderOfAxes) {
  const double moments[3] = {0.3, 0.7, 0.9};
  const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const Vec3d spins[] = {{3.0, 0.2, 0.1}, {0.2, 3.0, -0.3}, {-0.1, 0.4, -3.0}, {-2.0, -1.0, 1.5}};
  const Quatd start = normalized(Quatd{0.9, 0.1, -0.3, 0.2});
  for (const auto& order : orders)
    for (const Vec3d w : spins) {
      const Vec3d own{moments[order[0]], moments[order[1]], moments[order[2]]};
      const FreeTurning exact(own, w, start);
      EXPECT_LT(length(exact.angular_velocity(0.0) - w), 1e-12);
      EXPECT_LT(largest_difference(exact.attitude(0.0), matrix_of(start)), 1e-12);
      const State s = integrated(own, w, start, 3.0, 6000);
      EXPECT_LT(length(exact.angular_velocity(3.0) - s.w), 1e-8) << own.x << " " << own.y << " " << w.x;
      EXPECT_LT(largest_difference(exact.attitude(3.0), matrix_of(s.q)), 1e-8) << own.x << " " << own.y << " " << w.x;
    }
}

}  // namespace
}  // namespace broadside::tests
