#include "core/exact/feature_touch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/exact/integer_cubic.hpp"
#include "core/exact/integer_motion.hpp"

namespace broadside::exact {
namespace {

using Vector = std::array<IntegerCubic, 3>;  // of polynomials in time

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

IntegerCubic dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector place_of(const IntegerMotion& motion, int point) {
  Vector out;
  for (int axis = 0; axis < 3; ++axis) {
    out[axis].of_power[0] = motion.start[point][axis];
    out[axis].of_power[1] = motion.end[point][axis] - motion.start[point][axis];
  }
  return out;
}

// An axis along which a plane with this normal is not seen edge on; nothing when the vector is zero.
int axis_not_zero(const Vector& v, Root& at) {
  for (int axis = 0; axis < 3; ++axis)
    if (sign_at(v[axis], at) != 0) return axis;
  return -1;
}

// Whether x is in the closed segment p q, which may be a point: on its line, and between its ends on each axis.
bool is_in_segment(const Vector& x, const Vector& p, const Vector& q, Root& at) {
  if (axis_not_zero(cross(q - p, x - p), at) >= 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (sign_at((x - p)[axis], at) * sign_at((x - q)[axis], at) > 0) return false;
  return true;
}

// Tests of both kinds of features are reduced to signs of polynomials in time: `volume` of the four points, which is
// zero when they lie in one plane; the turning direction of three of them seen along an axis; and differences on one
// axis.
struct VertexFace {
  Vector p, a, b, c;
  Vector u, v, w;  // b, c and p from a
  IntegerCubic volume;

  explicit VertexFace(const IntegerMotion& m)
      : p(place_of(m, 0)), a(place_of(m, 1)), b(place_of(m, 2)), c(place_of(m, 3)), u(b - a), v(c - a), w(p - a) {
    volume = dot(cross(u, v), w);
  }

  // Precondition: the four points lie in one plane.
  [[nodiscard]] bool touch(Root& at) const {
    const Vector normal = cross(u, v);
    const int axis = axis_not_zero(normal, at);
    if (axis < 0) return is_in_segment(p, a, b, at) || is_in_segment(p, b, c, at) || is_in_segment(p, c, a, at);
    const int turn = sign_at(normal[axis], at);
    return turn * sign_at(cross(u, w)[axis], at) >= 0 && turn * sign_at(cross(v - u, w - u)[axis], at) >= 0 &&
           turn * sign_at(cross(w, v)[axis], at) >= 0;
  }

  // Between neighboring roots of these polynomials, no sign used above changes.
  [[nodiscard]] std::vector<IntegerCubic> events() const {
    std::vector<IntegerCubic> out;
    for (const Vector& f : {cross(u, v), cross(u, w), cross(v - u, w - u), cross(w, v), w, p - b, p - c})
      out.insert(out.end(), f.begin(), f.end());
    return out;
  }
};

struct EdgeEdge {
  Vector p, q, a, b;
  Vector u, v, w;  // q from p, b from a, a from p
  IntegerCubic volume;

  explicit EdgeEdge(const IntegerMotion& m)
      : p(place_of(m, 0)), q(place_of(m, 1)), a(place_of(m, 2)), b(place_of(m, 3)), u(q - p), v(b - a), w(a - p) {
    volume = dot(cross(u, v), w);
  }

  [[nodiscard]] bool touch(Root& at) const {
    const int axis = axis_not_zero(cross(u, v), at);
    if (axis < 0)  // parallel, or one is a point
      return is_in_segment(a, p, q, at) || is_in_segment(b, p, q, at) || is_in_segment(p, a, b, at) ||
             is_in_segment(q, a, b, at);
    // Each line has the other edge's ends on opposite sides, or an end on it.
    return sign_at(cross(u, w)[axis], at) * sign_at(cross(u, b - p)[axis], at) <= 0 &&
           sign_at(cross(v, p - a)[axis], at) * sign_at(cross(v, q - a)[axis], at) <= 0;
  }

  [[nodiscard]] std::vector<IntegerCubic> events() const {
    std::vector<IntegerCubic> out;
    for (const Vector& f :
         {cross(u, v), cross(u, w), cross(u, b - p), cross(v, p - a), cross(v, q - a), a - p, a - q, b - p, b - q})
      out.insert(out.end(), f.begin(), f.end());
    return out;
  }
};

// The number as a double; it is a multiple of 2^-bits with at most 53 bits.
double fraction(const mpz_class& place, unsigned bits) {
  return std::ldexp(place.get_d(), -static_cast<int>(bits));
}

TouchTime bracket(Root root, unsigned bits) {
  refine(root, bits);
  mpz_class low = root.place;
  mpz_class high = root.place + (root.is_exact ? 0 : 1);
  if (root.bits > bits) {
    mpz_fdiv_q_2exp(low.get_mpz_t(), low.get_mpz_t(), root.bits - bits);
    mpz_cdiv_q_2exp(high.get_mpz_t(), high.get_mpz_t(), root.bits - bits);
  }
  const unsigned shown = std::min(root.bits, bits);
  return {true, fraction(low, shown), fraction(high, shown)};
}

// The set of times at which closed features touch is closed. So its least element is 0, or a time at which a sign
// changes: a root of the volume, or where the volume is zero throughout, a root of one of the events.
template <typename Features>
TouchTime first_touch_of(const Features& features, unsigned bits) {
  TouchTime first;
  const auto try_root = [&](Root& root) {
    if (!features.touch(root)) return;
    const TouchTime found = bracket(root, bits);
    if (!first.touches) first = found;
    first.lower = std::min(first.lower, found.lower);
    first.upper = std::min(first.upper, found.upper);
  };
  if (!features.volume.is_zero()) {
    for (Root& root : roots_in_step(features.volume)) try_root(root);
    return first;
  }
  Root beginning{features.volume, 0, 0, 0, true};
  try_root(beginning);
  if (first.touches) return first;
  for (const IntegerCubic& event : features.events())
    if (!event.is_zero())
      for (Root& root : roots_in_step(event)) try_root(root);
  return first;
}

TouchTime first_touch_of(const IntegerMotion& motion, unsigned bits) {
  if (motion.kind == continuous::FeatureKind::kVertexFace) return first_touch_of(VertexFace(motion), bits);
  return first_touch_of(EdgeEdge(motion), bits);
}

}  // namespace

TouchTime first_touch(const continuous::MovingFeatures& features, unsigned bits) {
  return first_touch_of(integer_motion(features), bits);
}

core::Result<TouchTime> first_touch(const RationalFeatures& features, unsigned bits) {
  auto motion = integer_motion(features);
  if (!motion) return motion.error();
  return first_touch_of(motion.value(), bits);
}

}  // namespace broadside::exact
