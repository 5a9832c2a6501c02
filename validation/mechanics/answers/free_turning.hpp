// A body that turns freely: its angular velocity by Jacobi's functions, its attitude by Euler's angles about L.
#pragma once

#include <array>

#include "validation/mechanics/mat3d.hpp"

namespace broadside::validation {

class FreeTurning {
 public:
  // Principal moments along the body's own axes (kg m^2); w in body axes (rad/s) and the attitude at the start. The
  // body turns, and not about the middle axis exactly.
  FreeTurning(Vec3d moments, Vec3d w, Quatd start);

  [[nodiscard]] Vec3d angular_velocity(double t_s) const;  // body axes
  [[nodiscard]] Mat3d attitude(double t_s) const;          // world from body
  // How much an error of the start may grow: exp(K), since errors grow with at most lambda for a quarter of the period.
  [[nodiscard]] double growth() const;
  [[nodiscard]] double period_s() const;

 private:
  // Axes in the order of moments in which w2 crosses zero: rising, or falling where L^2 < 2 E I2.
  [[nodiscard]] Vec3d in_order(Vec3d body) const;
  [[nodiscard]] Vec3d from_order(Vec3d ordered) const;
  [[nodiscard]] Vec3d ordered_w(double t_s) const;
  [[nodiscard]] Mat3d about_momentum(double t_s, double angle) const;

  std::array<int, 3> axis_{0, 1, 2};
  double hand_ = 1.0;  // of the last axis, so that the ordered axes are right-handed
  Vec3d moments_;      // ordered
  Vec3d amplitude_;
  double rate_ = 0.0;       // lambda
  double parameter_ = 0.0;  // k^2
  double phase_ = 0.0;
  double flip_ = 1.0;  // of w1 and w3
  double momentum_ = 0.0;
  Mat3d world_from_momentum_;
};

}  // namespace broadside::validation
