// How the two bodies of a patch move against each other while the patch is solved: six numbers in the patch's axes,
// which are its normal (x) and its two tangents (y, z). Two products give a point's speed, and an impulse at a point
// adds a column that is known beforehand. So a sweep reads its bodies once as it begins and writes them once as it
// ends, and little is computed between two points.
#pragma once

#include "core/attributes.hpp"
#include "core/math/fused.hpp"
#include "core/math/lane_number.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// A's motion less B's.
template <typename Number>
struct TwistOf {
  VectorOf<Number> speed;  // at the patch's center, m/s
  VectorOf<Number> turn;   // rad/s
};

template <typename Number>
BROADSIDE_HD TwistOf<Number> plus(const TwistOf<Number>& t, Number times, const TwistOf<Number>& more) {
  return {plus_times(t.speed, times, more.speed), plus_times(t.turn, times, more.turn)};
}

// Of a point at `lever` from the patch's center, along each axis, m/s.
template <typename Number, typename Vector>
BROADSIDE_HD Number normal_speed(const TwistOf<Number>& t, const Vector& lever) {
  return less_product(plus_product(t.speed.x, t.turn.y, lever.z), t.turn.z, lever.y);
}
template <typename Number, typename Vector>
BROADSIDE_HD Number tangent_1_speed(const TwistOf<Number>& t, const Vector& lever) {
  return less_product(plus_product(t.speed.y, t.turn.z, lever.x), t.turn.x, lever.z);
}
template <typename Number, typename Vector>
BROADSIDE_HD Number tangent_2_speed(const TwistOf<Number>& t, const Vector& lever) {
  return less_product(plus_product(t.speed.z, t.turn.x, lever.y), t.turn.y, lever.x);
}

template <typename Number>
struct SymmetricOf {
  Number xx = 0.0F;
  Number yy = 0.0F;
  Number zz = 0.0F;
  Number xy = 0.0F;
  Number xz = 0.0F;
  Number yz = 0.0F;

  BROADSIDE_HD VectorOf<Number> x() const { return {xx, xy, xz}; }
  BROADSIDE_HD VectorOf<Number> y() const { return {xy, yy, yz}; }
  BROADSIDE_HD VectorOf<Number> z() const { return {xz, yz, zz}; }
};

// How a twist changes: by an impulse of 1 N s on A at the patch's center, with the opposite impulse on B; and by a
// moment of 1 N m s about an axis. The matrix of turns that impulses give is the transpose of the matrix of speeds that
// moments give.
template <typename Number>
struct TwistMobilityOf {
  SymmetricOf<Number> speed_by_push;   // 1/kg
  VectorOf<Number> speed_by_moment_x;  // 1/(kg m)
  VectorOf<Number> speed_by_moment_y;
  VectorOf<Number> speed_by_moment_z;
  SymmetricOf<Number> turn_by_moment;  // 1/(kg m^2)
};

// What an impulse of 1 N s along an axis does to the twist. Acting at `lever` it has the moment lever x axis.
template <typename Number, typename Vector>
BROADSIDE_HD TwistOf<Number> gain_by_normal(const TwistMobilityOf<Number>& m, const Vector& lever) {
  const VectorOf<Number> turn_by_push = {m.speed_by_moment_x.x, m.speed_by_moment_y.x, m.speed_by_moment_z.x};
  return {less_times(plus_times(m.speed_by_push.x(), lever.z, m.speed_by_moment_y), lever.y, m.speed_by_moment_z),
          less_times(plus_times(turn_by_push, lever.z, m.turn_by_moment.y()), lever.y, m.turn_by_moment.z())};
}
template <typename Number, typename Vector>
BROADSIDE_HD TwistOf<Number> gain_by_tangent_1(const TwistMobilityOf<Number>& m, const Vector& lever) {
  const VectorOf<Number> turn_by_push = {m.speed_by_moment_x.y, m.speed_by_moment_y.y, m.speed_by_moment_z.y};
  return {less_times(plus_times(m.speed_by_push.y(), lever.x, m.speed_by_moment_z), lever.z, m.speed_by_moment_x),
          less_times(plus_times(turn_by_push, lever.x, m.turn_by_moment.z()), lever.z, m.turn_by_moment.x())};
}
template <typename Number, typename Vector>
BROADSIDE_HD TwistOf<Number> gain_by_tangent_2(const TwistMobilityOf<Number>& m, const Vector& lever) {
  const VectorOf<Number> turn_by_push = {m.speed_by_moment_x.z, m.speed_by_moment_y.z, m.speed_by_moment_z.z};
  return {less_times(plus_times(m.speed_by_push.z(), lever.y, m.speed_by_moment_x), lever.x, m.speed_by_moment_y),
          less_times(plus_times(turn_by_push, lever.y, m.turn_by_moment.x()), lever.x, m.turn_by_moment.y())};
}

// One body's share of the mobility. center: from its center of mass to the patch's center, world axes.
template <typename Number, typename Body, typename Vector>
BROADSIDE_HD void add_mobility(TwistMobilityOf<Number>& m, const Body& body, const Vector& x, const Vector& y,
                               const Vector& z, const Vector& center) {
  const Vector by_x = body.inverse_inertia * x;
  const Vector by_y = body.inverse_inertia * y;
  const Vector by_z = body.inverse_inertia * z;
  // Columns of the inverse inertia in the patch's axes.
  const Number xy = dot(x, by_y);
  const Number xz = dot(x, by_z);
  const Number yz = dot(y, by_z);
  const Vector turn_x = {dot(x, by_x), xy, xz};
  const Vector turn_y = {xy, dot(y, by_y), yz};
  const Vector turn_z = {xz, yz, dot(z, by_z)};
  const Vector arm = {dot(x, center), dot(y, center), dot(z, center)};
  const Vector speed_x = cross(turn_x, arm);
  const Vector speed_y = cross(turn_y, arm);
  const Vector speed_z = cross(turn_z, arm);
  SymmetricOf<Number>& push = m.speed_by_push;
  push.xx = push.xx + (body.inverse_mass + (arm.z * speed_y.x - arm.y * speed_z.x));
  push.xy = push.xy + (arm.z * speed_y.y - arm.y * speed_z.y);
  push.xz = push.xz + (arm.z * speed_y.z - arm.y * speed_z.z);
  push.yy = push.yy + (body.inverse_mass + (arm.x * speed_z.y - arm.z * speed_x.y));
  push.yz = push.yz + (arm.x * speed_z.z - arm.z * speed_x.z);
  push.zz = push.zz + (body.inverse_mass + (arm.y * speed_x.z - arm.x * speed_y.z));
  m.speed_by_moment_x = m.speed_by_moment_x + speed_x;
  m.speed_by_moment_y = m.speed_by_moment_y + speed_y;
  m.speed_by_moment_z = m.speed_by_moment_z + speed_z;
  SymmetricOf<Number>& turn = m.turn_by_moment;
  turn.xx = turn.xx + turn_x.x;
  turn.xy = turn.xy + xy;
  turn.xz = turn.xz + xz;
  turn.yy = turn.yy + turn_y.y;
  turn.yz = turn.yz + yz;
  turn.zz = turn.zz + turn_z.z;
}

// visit(x, y) for each number x of one mobility and the same number y of the other.
template <typename One, typename Other, typename Visit>
BROADSIDE_HD void each_of_mobilities(One& one, Other& other, const Visit& visit) {
  const auto symmetric = [&](auto& m, auto& n) {
    visit(m.xx, n.xx);
    visit(m.yy, n.yy);
    visit(m.zz, n.zz);
    visit(m.xy, n.xy);
    visit(m.xz, n.xz);
    visit(m.yz, n.yz);
  };
  const auto vector = [&](auto& v, auto& w) {
    visit(v.x, w.x);
    visit(v.y, w.y);
    visit(v.z, w.z);
  };
  symmetric(one.speed_by_push, other.speed_by_push);
  vector(one.speed_by_moment_x, other.speed_by_moment_x);
  vector(one.speed_by_moment_y, other.speed_by_moment_y);
  vector(one.speed_by_moment_z, other.speed_by_moment_z);
  symmetric(one.turn_by_moment, other.turn_by_moment);
}

}  // namespace broadside::core
