#include "validation/mechanics/answers/free_turning.hpp"

#include <algorithm>
#include <cmath>

#include "validation/mechanics/answers/jacobi.hpp"

namespace broadside::validation {
namespace {

double part(Vec3d v, int axis) {
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

// Steps of Simpson's rule in a period. What varies fastest does so within 1 / lambda, a period over 4 K; for k^2 up to
// 1 - 1e-6, K is below 9, and the error of the integral is of the order of (4 K / steps)^4, below 1e-8 rad.
constexpr double kStepsInAPeriod = 2000.0;

Quatd about(int axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), axis == 0 ? s : 0.0, axis == 1 ? s : 0.0, axis == 2 ? s : 0.0};
}

Mat3d from_columns(Vec3d a, Vec3d b, Vec3d c) {
  return {{Vec3d{a.x, b.x, c.x}, Vec3d{a.y, b.y, c.y}, Vec3d{a.z, b.z, c.z}}};
}

Mat3d transposed(const Mat3d& m) {
  return from_columns(m.row[0], m.row[1], m.row[2]);
}

Mat3d product(const Mat3d& a, const Mat3d& b) {
  const Mat3d t = transposed(b);
  return from_columns(a * t.row[0], a * t.row[1], a * t.row[2]);
}

}  // namespace

FreeTurning::FreeTurning(Vec3d moments, Vec3d w, Quatd start) {
  std::sort(axis_.begin(), axis_.end(), [&](int i, int j) { return part(moments, i) < part(moments, j); });
  const Vec3d l{moments.x * w.x, moments.y * w.y, moments.z * w.z};
  const double squared = dot(l, l);
  const double energy_2 = dot(l, w);
  if (squared < energy_2 * part(moments, axis_[1])) std::swap(axis_[0], axis_[2]);
  // An odd order of the axes turns the last one round.
  const bool is_even = (axis_[1] - axis_[0] + 3) % 3 == 1;
  hand_ = is_even ? 1.0 : -1.0;
  moments_ = {part(moments, axis_[0]), part(moments, axis_[1]), part(moments, axis_[2])};
  const auto [a, b, c] = std::array{moments_.x, moments_.y, moments_.z};
  // Landau and Lifshitz, Mechanics, section 37. Where the ordered moments fall, two negative factors cancel, and time
  // runs the other way along the same curve.
  rate_ = std::copysign(std::sqrt((c - b) * (squared - energy_2 * a) / (a * b * c)), c - a);
  parameter_ = (b - a) * (energy_2 * c - squared) / ((c - b) * (squared - energy_2 * a));
  amplitude_ = {std::sqrt((energy_2 * c - squared) / (a * (c - a))),
                std::sqrt((energy_2 * c - squared) / (b * (c - b))),
                std::sqrt((squared - energy_2 * a) / (c * (c - a)))};
  const Vec3d w0 = in_order(w);
  flip_ = w0.z < 0.0 ? -1.0 : 1.0;
  // A body that turns about an axis alone has no amplitude across it.
  phase_ =
      amplitude_.x > 0.0 ? elliptic_f(std::atan2(w0.y / amplitude_.y, flip_ * w0.x / amplitude_.x), parameter_) : 0.0;
  momentum_ = std::sqrt(squared);
  world_from_momentum_ = product(matrix_of(start), transposed(about_momentum(0.0, 0.0)));
}

Vec3d FreeTurning::in_order(Vec3d v) const {
  return {part(v, axis_[0]), part(v, axis_[1]), hand_ * part(v, axis_[2])};
}

Vec3d FreeTurning::from_order(Vec3d v) const {
  double out[3];
  out[axis_[0]] = v.x;
  out[axis_[1]] = v.y;
  out[axis_[2]] = hand_ * v.z;
  return {out[0], out[1], out[2]};
}

Vec3d FreeTurning::ordered_w(double t) const {
  const Jacobi f = jacobi(rate_ * t + phase_, parameter_);
  return {flip_ * amplitude_.x * f.cn, amplitude_.y * f.sn, flip_ * amplitude_.z * f.dn};
}

Vec3d FreeTurning::angular_velocity(double t) const {
  return from_order(ordered_w(t));
}

// World from body, but for a constant turn, when the line of nodes has gone round L by `angle`: L in ordered body axes
// gives the other two of Euler's angles.
Mat3d FreeTurning::about_momentum(double t, double angle) const {
  const Vec3d w = ordered_w(t);
  const Vec3d l{moments_.x * w.x / momentum_, moments_.y * w.y / momentum_, moments_.z * w.z / momentum_};
  const double tilt = std::atan2(std::hypot(l.x, l.y), l.z);
  const double own = std::atan2(l.x, l.y);
  const Mat3d turn = matrix_of(about(2, angle) * about(0, tilt) * about(2, own));
  // The columns are the images of the body's own axes.
  return from_columns(turn * in_order({1, 0, 0}), turn * in_order({0, 1, 0}), turn * in_order({0, 0, 1}));
}

Mat3d FreeTurning::attitude(double t) const {
  // How fast the line of nodes goes round L: L (I1 w1^2 + I2 w2^2) / (I1^2 w1^2 + I2^2 w2^2).
  const auto precession = [&](double s) {
    const Vec3d w = ordered_w(s);
    const double x = moments_.x * w.x;
    const double y = moments_.y * w.y;
    return momentum_ * (x * w.x + y * w.y) / (x * x + y * y);
  };
  const int steps = 2 * static_cast<int>(std::ceil(0.5 * t / period_s() * kStepsInAPeriod + 1.0));
  const double h = t / steps;
  double sum = precession(0.0) + precession(t);
  for (int k = 1; k < steps; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * precession(k * h);
  return product(world_from_momentum_, about_momentum(t, sum * h / 3.0));
}

double FreeTurning::growth() const {
  return std::exp(quarter_period(parameter_));
}

double FreeTurning::period_s() const {
  return 4.0 * quarter_period(parameter_) / std::abs(rate_);
}

}  // namespace broadside::validation
