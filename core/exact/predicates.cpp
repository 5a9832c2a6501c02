#include "core/exact/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace broadside::exact {
namespace {

// A sum of nonoverlapping doubles, smallest first. Its value is exact, and its sign is that of the last one.
template <std::size_t Capacity>
struct Expansion {
  std::array<double, Capacity> term{};
  std::size_t size = 0;

  void push(double x) {
    if (x != 0.0) term[size++] = x;
  }
  [[nodiscard]] int sign() const { return size == 0 ? 0 : (term[size - 1] > 0.0 ? 1 : -1); }
};

struct Two {
  double high, low;
};

Two two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

Two two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// Adds one double; the result is again an expansion.
template <std::size_t N>
Expansion<N + 1> plus(const Expansion<N>& e, double x) {
  Expansion<N + 1> out;
  for (std::size_t k = 0; k < e.size; ++k) {
    const Two t = two_sum(x, e.term[k]);
    out.push(t.low);
    x = t.high;
  }
  out.push(x);
  return out;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> sum(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> out;
  for (std::size_t k = 0; k < e.size; ++k) out.push(e.term[k]);
  for (std::size_t k = 0; k < f.size; ++k) {
    double x = f.term[k];
    Expansion<N + M> next;
    for (std::size_t i = 0; i < out.size; ++i) {
      const Two t = two_sum(x, out.term[i]);
      next.push(t.low);
      x = t.high;
    }
    next.push(x);
    out = next;
  }
  return out;
}

template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& e, double s) {
  Expansion<2 * N> out;
  for (std::size_t k = 0; k < e.size; ++k) {
    const Two t = two_product(e.term[k], s);
    Expansion<2> product;
    product.push(t.low);
    product.push(t.high);
    Expansion<2 * N> grown;
    std::size_t at = 0;
    for (; at < out.size; ++at) grown.term[at] = out.term[at];
    grown.size = at;
    for (std::size_t p = 0; p < product.size; ++p) {
      double x = product.term[p];
      Expansion<2 * N> next;
      for (std::size_t i = 0; i < grown.size; ++i) {
        const Two s2 = two_sum(x, grown.term[i]);
        next.push(s2.low);
        x = s2.high;
      }
      next.push(x);
      grown = next;
    }
    out = grown;
  }
  return out;
}

template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<2 * N * M> out;
  for (std::size_t k = 0; k < f.size; ++k) {
    const Expansion<2 * N> part = scaled(e, f.term[k]);
    const auto total = sum(out, part);
    out.size = 0;
    for (std::size_t i = 0; i < total.size; ++i) out.push(total.term[i]);
  }
  return out;
}

Expansion<2> difference(double a, double b) {
  const Two t = two_sum(a, -b);
  Expansion<2> out;
  out.push(t.low);
  out.push(t.high);
  return out;
}

template <std::size_t N>
Expansion<N> negated(Expansion<N> e) {
  for (std::size_t k = 0; k < e.size; ++k) e.term[k] = -e.term[k];
  return e;
}

// The 2 x 2 determinant p x q of exact differences.
auto determinant2(const Expansion<2>& px, const Expansion<2>& py, const Expansion<2>& qx, const Expansion<2>& qy) {
  return sum(product(px, qy), negated(product(py, qx)));
}

int exact_orientation(Point a, Point b, Point c, Point d) {
  const auto ax = difference(a.x, d.x), ay = difference(a.y, d.y), az = difference(a.z, d.z);
  const auto bx = difference(b.x, d.x), by = difference(b.y, d.y), bz = difference(b.z, d.z);
  const auto cx = difference(c.x, d.x), cy = difference(c.y, d.y), cz = difference(c.z, d.z);
  const auto first = product(determinant2(bx, by, cx, cy), az);
  const auto second = product(determinant2(cx, cy, ax, ay), bz);
  const auto third = product(determinant2(ax, ay, bx, by), cz);
  return sum(sum(first, second), third).sign();
}

// Sign of the turn a, b, c in the plane that remains when one axis is dropped.
int turn(Point a, Point b, Point c, int dropped) {
  const auto u = [&](Point p) { return dropped == 0 ? p.y : p.x; };
  const auto v = [&](Point p) { return dropped == 2 ? p.y : p.z; };
  return determinant2(difference(u(a), u(c)), difference(v(a), v(c)), difference(u(b), u(c)), difference(v(b), v(c)))
      .sign();
}

bool within(double x, double p, double q) {
  return std::min(p, q) <= x && x <= std::max(p, q);
}

// Given that c lies on the line through a and b as seen along the dropped axis: is it between them?
bool in_box(Point a, Point b, Point c, int dropped) {
  return (dropped == 0 || within(c.x, a.x, b.x)) && (dropped == 1 || within(c.y, a.y, b.y)) &&
         (dropped == 2 || within(c.z, a.z, b.z));
}

bool segments_meet_in_plane(Point p, Point q, Point a, Point b, int dropped) {
  const int pa = turn(p, q, a, dropped);
  const int pb = turn(p, q, b, dropped);
  const int ap = turn(a, b, p, dropped);
  const int aq = turn(a, b, q, dropped);
  if (pa * pb < 0 && ap * aq < 0) return true;
  return (pa == 0 && in_box(p, q, a, dropped)) || (pb == 0 && in_box(p, q, b, dropped)) ||
         (ap == 0 && in_box(a, b, p, dropped)) || (aq == 0 && in_box(a, b, q, dropped));
}

// Segments meet only when their four points lie in one plane. Then a projection along an axis along which the plane is
// not seen edge on gives the exact answer; other projections can only err towards yes. So all three must say yes.
bool segments_meet(Point p, Point q, Point a, Point b) {
  if (orientation(p, q, a, b) != 0) return false;
  for (int dropped = 0; dropped < 3; ++dropped)
    if (!segments_meet_in_plane(p, q, a, b, dropped)) return false;
  return true;
}

// Precondition: p is in the triangle's plane, or the triangle has no area.
bool is_in_triangle(Point p, const Corners& t) {
  for (int dropped = 0; dropped < 3; ++dropped) {
    const int a = turn(t[0], t[1], p, dropped);
    const int b = turn(t[1], t[2], p, dropped);
    const int c = turn(t[2], t[0], p, dropped);
    if (std::max({a, b, c}) > 0 && std::min({a, b, c}) < 0) return false;
  }
  // Inside a triangle that has area. The caller tests the edges of a triangle without area.
  for (int dropped = 0; dropped < 3; ++dropped)
    if (turn(t[0], t[1], t[2], dropped) != 0) return true;
  return false;
}

bool segment_meets(Point p, Point q, const Corners& t) {
  const int side_p = orientation(t[0], t[1], t[2], p);
  const int side_q = orientation(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    for (int k = 0; k < 3; ++k)
      if (segments_meet(p, q, t[k], t[(k + 1) % 3])) return true;
    return is_in_triangle(p, t) || is_in_triangle(q, t);
  }
  // The line passes all three edges on the same side, or through them.
  int least = 1;
  int most = -1;
  for (int k = 0; k < 3; ++k) {
    const int side = orientation(p, q, t[k], t[(k + 1) % 3]);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return !(least < 0 && most > 0);
}

}  // namespace

int orientation(Point a, Point b, Point c, Point d) {
  const Point u = a - d;
  const Point v = b - d;
  const Point w = c - d;
  const double first = (v.x * w.y - v.y * w.x) * u.z;
  const double second = (w.x * u.y - w.y * u.x) * v.z;
  const double third = (u.x * v.y - u.y * v.x) * w.z;
  const double determinant = first + second + third;
  const double size = (std::abs(v.x * w.y) + std::abs(v.y * w.x)) * std::abs(u.z) +
                      (std::abs(w.x * u.y) + std::abs(w.y * u.x)) * std::abs(v.z) +
                      (std::abs(u.x * v.y) + std::abs(u.y * v.x)) * std::abs(w.z);
  // Shewchuk's bound of the determinant's error is (7 + 56 u) u size, u = 2^-53.
  if (std::abs(determinant) > 8.0 * 0x1p-53 * size) return determinant > 0.0 ? 1 : -1;
  return exact_orientation(a, b, c, d);
}

bool triangles_meet(const Corners& a, const Corners& b) {
  for (int k = 0; k < 3; ++k)
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

}  // namespace broadside::exact
