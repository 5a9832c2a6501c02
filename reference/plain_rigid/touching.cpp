#include "reference/plain_rigid/touching.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace broadside::reference::plain {
namespace {

void sphere_sphere(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  const Vec d = a.origin() - b.origin();
  const double distance = length(d);
  const double gap = distance - (a.radius + b.radius);
  if (!(gap <= reach)) return;
  const Vec n = distance > 0.0 ? (1.0 / distance) * d : Vec{1, 0, 0};
  out.push_back({b.origin() + (b.radius + 0.5 * gap) * n, n, gap});
}

// The point of a polygon that is nearest to p.
Vec nearest_on_face(const Polytope& shape, const PolytopeFace& face, Vec p) {
  const Vec on_plane = p - dot(face.normal, p - shape.vertices[face.corners[0]]) * face.normal;
  bool is_inside = true;
  Vec best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Vec a = shape.vertices[face.corners[k]];
    const Vec d = shape.vertices[face.corners[(k + 1) % face.corners.size()]] - a;
    is_inside = is_inside && dot(cross(face.normal, d), on_plane - a) >= 0.0;
    const Vec near = a + std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) * d;
    if (length(p - near) < least) least = length(p - near), best = near;
  }
  return is_inside ? on_plane : best;
}

// Normal from the polytope to the sphere, times `turn`.
void sphere_polytope(const RigidBody& sphere, const RigidBody& other, double reach, double turn,
                     std::vector<NearPoint>& out) {
  const Polytope shape = placed(*other.polytope, other.rotation(), other.origin());
  const Vec center = sphere.origin();
  // The face that the center is farthest in front of, or least behind.
  const PolytopeFace* front = nullptr;
  double height = -std::numeric_limits<double>::infinity();
  for (const PolytopeFace& f : shape.faces) {
    const double h = dot(f.normal, center - shape.vertices[f.corners[0]]);
    if (h > height) height = h, front = &f;
  }
  Vec n = front->normal;
  Vec nearest = center - height * n;
  if (height > 0.0) {
    double least = std::numeric_limits<double>::infinity();
    for (const PolytopeFace& f : shape.faces) {
      const Vec p = nearest_on_face(shape, f, center);
      if (length(center - p) < least) least = length(center - p), nearest = p;
    }
    height = least;
    n = (1.0 / least) * (center - nearest);
  }
  const double gap = height - sphere.radius;
  if (gap <= reach) out.push_back({nearest + (0.5 * gap) * n, turn * n, gap});
}

// One direction along which two polytopes are compared.
struct Separation {
  double gap = -std::numeric_limits<double>::infinity();
  Vec normal;  // from B to A
  const PolytopeFace* face_of_a = nullptr;
  const PolytopeFace* face_of_b = nullptr;
  Vec direction_of_a;  // of edges, where no face decides
  Vec direction_of_b;
};

double lowest(const Polytope& shape, Vec n) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec p : shape.vertices) least = std::min(least, dot(n, p));
  return least;
}

// The direction with the largest gap among the normals of faces.
Separation widest_face(const Polytope& a, const Polytope& b) {
  Separation best;
  for (const PolytopeFace& f : a.faces) {
    const double gap = lowest(b, f.normal) - dot(f.normal, a.vertices[f.corners[0]]);
    if (gap > best.gap) best = {gap, -f.normal, &f, nullptr, {}, {}};
  }
  for (const PolytopeFace& f : b.faces) {
    const double gap = lowest(a, f.normal) - dot(f.normal, b.vertices[f.corners[0]]);
    if (gap > best.gap) best = {gap, f.normal, nullptr, &f, {}, {}};
  }
  return best;
}

// The direction with the largest gap among those across an edge of each body.
Separation widest_edges(const Polytope& a, const Polytope& b) {
  Separation best;
  for (const Vec u : a.directions)
    for (const Vec w : b.directions) {
      const Vec c = cross(u, w);
      const double size = length(c);
      if (!(size > 1e-6)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vec n = (sign / size) * c;
        const double gap = lowest(a, n) + lowest(b, -n);
        if (gap > best.gap) best = {gap, n, nullptr, nullptr, u, w};
      }
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

// The face of the other polytope that is turned most toward `face`, clipped by the sides of `face`.
void face_points(const Polytope& own, const PolytopeFace& face, const Polytope& other, Vec normal, double reach,
                 std::vector<NearPoint>& out) {
  const auto incident =
      std::min_element(other.faces.begin(), other.faces.end(), [&](const PolytopeFace& p, const PolytopeFace& q) {
        return dot(p.normal, face.normal) < dot(q.normal, face.normal);
      });
  std::vector<Vec> polygon;
  for (const std::uint32_t k : incident->corners) polygon.push_back(other.vertices[k]);
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Vec a = own.vertices[face.corners[k]];
    const Vec side = cross(own.vertices[face.corners[(k + 1) % face.corners.size()]] - a, face.normal);
    const Vec outward = (1.0 / length(side)) * side;
    polygon = clipped(polygon, outward, dot(outward, a));
  }
  const double plane = dot(face.normal, own.vertices[face.corners[0]]);
  for (const Vec p : polygon) {
    const double gap = dot(face.normal, p) - plane;
    if (gap <= reach) out.push_back({p - (0.5 * gap) * face.normal, normal, gap});
  }
}

// The edge along d that reaches farthest toward n.
std::pair<Vec, Vec> farthest_edge(const Polytope& shape, Vec d, Vec n) {
  std::pair<Vec, Vec> best;
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& [i, j] : shape.edges) {
    const Vec p = shape.vertices[i];
    const Vec q = shape.vertices[j];
    if (length(cross(q - p, d)) > 1e-6 * length(q - p)) continue;
    const double reach = dot(n, 0.5 * (p + q));
    if (reach > most) most = reach, best = {p, q};
  }
  return best;
}

// The middle of the shortest connection between the two edges that face each other. Nothing where that connection is
// not along the normal: then the edges pass each other, and a face is nearest.
std::optional<NearPoint> edge_point(const Polytope& a, const Polytope& b, const Separation& best, double size) {
  constexpr double kBeside = 1e-6;
  const auto [p, p_end] = farthest_edge(a, best.direction_of_a, -best.normal);
  const auto [q, q_end] = farthest_edge(b, best.direction_of_b, best.normal);
  const Vec u = p_end - p;
  const Vec w = q_end - q;
  const Vec d = p - q;
  const double uu = dot(u, u);
  const double ww = dot(w, w);
  const double uw = dot(u, w);
  const double scale = uu * ww - uw * uw;
  const double s = std::clamp((uw * dot(w, d) - ww * dot(u, d)) / scale, 0.0, 1.0);
  const double t = std::clamp((uu * dot(w, d) - uw * dot(u, d)) / scale, 0.0, 1.0);
  const Vec on_a = p + s * u;
  const Vec on_b = q + t * w;
  if (length((on_a - on_b) - best.gap * best.normal) > kBeside * size) return std::nullopt;
  return NearPoint{0.5 * (on_a + on_b), best.normal, best.gap};
}

void polytope_polytope(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  // Edges have to win by a margin, since a face gives more points.
  constexpr double kEdgeMargin = 1e-9;
  const double size = a.reach + b.reach;
  const Polytope pa = placed(*a.polytope, a.rotation(), a.origin());
  const Polytope pb = placed(*b.polytope, b.rotation(), b.origin());
  const Separation face = widest_face(pa, pb);
  if (!(face.gap <= reach)) return;
  const Separation edges = widest_edges(pa, pb);
  if (!(edges.gap <= reach)) return;
  if (edges.gap > face.gap + kEdgeMargin * size)
    if (const auto point = edge_point(pa, pb, edges, size)) return out.push_back(*point);
  if (face.face_of_a != nullptr)
    face_points(pa, *face.face_of_a, pb, face.normal, reach, out);
  else
    face_points(pb, *face.face_of_b, pa, face.normal, reach, out);
}

}  // namespace

void near_points(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out) {
  if (a.is_sphere() && b.is_sphere()) return sphere_sphere(a, b, reach, out);
  if (a.is_sphere()) return sphere_polytope(a, b, reach, 1.0, out);
  if (b.is_sphere()) return sphere_polytope(b, a, reach, -1.0, out);
  polytope_polytope(a, b, reach, out);
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
  if (a.is_sphere()) return add(a.origin() - a.radius * n);
  const Mat r = a.rotation();
  const Vec c = a.origin();
  for (const Vec p : a.polytope->vertices) add(c + r * p);
}

}  // namespace broadside::reference::plain
