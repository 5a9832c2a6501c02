#include "reference/plain_rigid/touching.hpp"

#include <array>
#include <limits>
#include <utility>

namespace broadside::reference::plain {
namespace {

using core::PrimitiveKind;

void sphere_sphere(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  const Vec d = a.origin() - b.origin();
  const double distance = length(d);
  const double gap = distance - (a.radius + b.radius);
  if (!(gap <= reach)) return;
  const Vec n = distance > 0.0 ? (1.0 / distance) * d : Vec{1, 0, 0};
  out.push_back({b.origin() + (b.radius + 0.5 * gap) * n, n, gap});
}

// Normal from the box to the sphere.
void sphere_box(const RigidBody& sphere, const RigidBody& box, double reach, double turn, std::vector<NearPoint>& out) {
  const Mat r = box.rotation();
  const Vec p = transposed(r) * (sphere.origin() - box.origin());
  Vec nearest;
  bool is_inside = true;
  for (int k = 0; k < 3; ++k) {
    nearest[k] = std::clamp(p[k], -box.half_extents[k], box.half_extents[k]);
    is_inside = is_inside && nearest[k] == p[k];
  }
  Vec n;
  double distance = 0.0;
  if (is_inside) {
    // Out through the nearest face.
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (box.half_extents[k] - std::abs(p[k]) < box.half_extents[axis] - std::abs(p[axis])) axis = k;
    const double sign = p[axis] < 0.0 ? -1.0 : 1.0;
    n = sign * axis_of(axis);
    distance = std::abs(p[axis]) - box.half_extents[axis];
    nearest[axis] = sign * box.half_extents[axis];
  } else {
    distance = length(p - nearest);
    n = (1.0 / distance) * (p - nearest);
  }
  const double gap = distance - sphere.radius;
  if (!(gap <= reach)) return;
  const Vec world = r * n;
  out.push_back({box.origin() + r * nearest + (0.5 * gap) * world, turn * world, gap});
}

// One direction along which two boxes are compared.
struct Separation {
  double gap = -std::numeric_limits<double>::infinity();
  Vec normal;  // from B to A
  int face_of_a = -1;
  int face_of_b = -1;
  std::array<int, 2> edges{-1, -1};
};

struct Boxes {
  Mat ra;  // columns: the axes of A
  Mat rb;
  Vec ha;
  Vec hb;
  Vec ca;
  Vec cb;
};

double reach_of(const Mat& r, Vec half, Vec n) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += half[k] * std::abs(dot(column(r, k), n));
  return sum;
}

// The separating direction with the largest gap: the six face normals, then the nine cross products of edges, which
// have to win by a margin, since a face gives more points.
Separation widest(const Boxes& s) {
  constexpr double kEdgeMargin = 1e-9;
  Separation best;
  const Vec d = s.ca - s.cb;
  const double size = length(s.ha) + length(s.hb);
  const auto consider = [&](Vec n, int face_a, int face_b, std::array<int, 2> edges) {
    if (dot(n, d) < 0.0) n = -n;
    const double gap = dot(n, d) - reach_of(s.ra, s.ha, n) - reach_of(s.rb, s.hb, n);
    const double margin = edges[0] < 0 ? 0.0 : kEdgeMargin * size;
    if (gap > best.gap + margin) best = {gap, n, face_a, face_b, edges};
  };
  for (int k = 0; k < 3; ++k) consider(column(s.ra, k), k, -1, {-1, -1});
  for (int k = 0; k < 3; ++k) consider(column(s.rb, k), -1, k, {-1, -1});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec n = cross(column(s.ra, i), column(s.rb, j));
      const double size_n = length(n);
      if (size_n > 1e-6) consider((1.0 / size_n) * n, -1, -1, {i, j});
    }
  return best;
}

// Keeps the part of a polygon with dot(n, p) <= limit.
std::vector<Vec> clipped(const std::vector<Vec>& polygon, Vec n, double limit) {
  std::vector<Vec> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec p = polygon[k];
    const Vec q = polygon[(k + 1) % polygon.size()];
    const double dp = dot(n, p) - limit;
    const double dq = dot(n, q) - limit;
    if (dp <= 0.0) kept.push_back(p);
    if ((dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0)) kept.push_back(p + (dp / (dp - dq)) * (q - p));
  }
  return kept;
}

// The face of the other box that looks most against n, clipped by the sides of the reference face.
void face_points(const Mat& rr, Vec hr, Vec cr, int face, Vec outward, const Mat& ri, Vec hi, Vec ci, Vec normal,
                 double reach, std::vector<NearPoint>& out) {
  int incident = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(dot(column(ri, k), outward)) > std::abs(dot(column(ri, incident), outward))) incident = k;
  const double side = dot(column(ri, incident), outward) > 0.0 ? -1.0 : 1.0;
  const Vec u = hi[(incident + 1) % 3] * column(ri, (incident + 1) % 3);
  const Vec w = hi[(incident + 2) % 3] * column(ri, (incident + 2) % 3);
  const Vec middle = ci + (side * hi[incident]) * column(ri, incident);
  std::vector<Vec> polygon{middle + u + w, middle - u + w, middle - u - w, middle + u - w};
  for (int k = 1; k < 3; ++k) {
    const int axis = (face + k) % 3;
    const Vec n = column(rr, axis);
    polygon = clipped(polygon, n, dot(n, cr) + hr[axis]);
    polygon = clipped(polygon, -n, -dot(n, cr) + hr[axis]);
  }
  const double plane = dot(outward, cr) + hr[face];
  for (const Vec p : polygon) {
    const double gap = dot(outward, p) - plane;
    if (gap <= reach) out.push_back({p - (0.5 * gap) * outward, normal, gap});
  }
}

// The middle of the shortest way between the two edges that face each other.
void edge_point(const Boxes& s, const Separation& best, std::vector<NearPoint>& out) {
  const auto edge = [](const Mat& r, Vec h, Vec c, int along, Vec towards) {
    Vec p = c;
    for (int k = 0; k < 3; ++k)
      if (k != along) p = p + (dot(column(r, k), towards) > 0.0 ? h[k] : -h[k]) * column(r, k);
    return p;
  };
  const Vec p = edge(s.ra, s.ha, s.ca, best.edges[0], -best.normal);
  const Vec q = edge(s.rb, s.hb, s.cb, best.edges[1], best.normal);
  const Vec u = column(s.ra, best.edges[0]);
  const Vec w = column(s.rb, best.edges[1]);
  const double b = dot(u, w);
  const double scale = 1.0 - b * b;
  const Vec d = p - q;
  const double s_a = std::clamp((b * dot(w, d) - dot(u, d)) / scale, -s.ha[best.edges[0]], s.ha[best.edges[0]]);
  const double s_b = std::clamp((dot(w, d) - b * dot(u, d)) / scale, -s.hb[best.edges[1]], s.hb[best.edges[1]]);
  out.push_back({0.5 * ((p + s_a * u) + (q + s_b * w)), best.normal, best.gap});
}

void box_box(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  const Boxes s{a.rotation(), b.rotation(), a.half_extents, b.half_extents, a.origin(), b.origin()};
  const Separation best = widest(s);
  if (!(best.gap <= reach)) return;
  if (best.face_of_a >= 0)
    face_points(s.ra, s.ha, s.ca, best.face_of_a, -best.normal, s.rb, s.hb, s.cb, best.normal, reach, out);
  else if (best.face_of_b >= 0)
    face_points(s.rb, s.hb, s.cb, best.face_of_b, best.normal, s.ra, s.ha, s.ca, best.normal, reach, out);
  else
    edge_point(s, best, out);
}

}  // namespace

void near_points(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  const bool is_a_sphere = a.kind == PrimitiveKind::kSphere;
  const bool is_b_sphere = b.kind == PrimitiveKind::kSphere;
  if (is_a_sphere && is_b_sphere) return sphere_sphere(a, b, reach, out);
  if (is_a_sphere) return sphere_box(a, b, reach, 1.0, out);
  if (is_b_sphere) return sphere_box(b, a, reach, -1.0, out);
  box_box(a, b, reach, out);
}

void near_points(const RigidBody& a, const core::Box& domain, std::uint32_t face, double reach,
                 std::vector<NearPoint>& out) {
  const int axis = static_cast<int>(face / 2);
  const bool is_upper = face % 2 == 1;
  const double wall = is_upper ? domain.max[axis] : domain.min[axis];
  const Vec n = (is_upper ? -1.0 : 1.0) * axis_of(axis);
  const auto add = [&](Vec p) {
    const double gap = is_upper ? wall - p[axis] : p[axis] - wall;
    if (gap <= reach) out.push_back({p - (0.5 * gap) * n, n, gap});
  };
  if (a.kind == PrimitiveKind::kSphere) return add(a.origin() - a.radius * n);
  const Mat r = a.rotation();
  const Vec c = a.origin();
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec local = a.half_extents;
    for (int k = 0; k < 3; ++k)
      if ((corner >> static_cast<unsigned>(k) & 1U) == 0) local[k] = -local[k];
    add(c + r * local);
  }
}

}  // namespace broadside::reference::plain
