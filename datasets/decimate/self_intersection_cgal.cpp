#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <array>
#include <exception>
#include <string>
#include <vector>

#include "datasets/decimate/self_intersection.hpp"

namespace broadside::datasets {
namespace {

// Predicates are exact for the vertices, which are floats.
using PredicateKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FacetPoint = PredicateKernel::Point_3;
using Segment = PredicateKernel::Segment_3;
using Facet = PredicateKernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

// The corners that two triangles share, as indices of corners in each triangle.
struct Shared {
  int count = 0;
  int in_a[3] = {};  // corners of a that are corners of b, then the others
  int in_b[3] = {};
};

Shared shared_corners(const core::Triangle& a, const core::Triangle& b) {
  Shared s;
  bool is_used[3] = {};
  int others = 3;
  for (int k = 0; k < 3; ++k) {
    int match = -1;
    for (int m = 0; m < 3; ++m)
      if (a[k] == b[m] && !is_used[m]) match = m;
    if (match < 0) {
      s.in_a[--others] = k;
      continue;
    }
    is_used[match] = true;
    s.in_a[s.count] = k;
    s.in_b[s.count++] = match;
  }
  for (int m = 0, at = s.count; m < 3; ++m)
    if (!is_used[m]) s.in_b[at++] = m;
  return s;
}

// Element k is corner k of a triangle.
using Corners = std::array<FacetPoint, 3>;

bool cross(const core::Triangle& ta, const core::Triangle& tb, const Corners& a, const Corners& b) {
  const Facet fa(a[0], a[1], a[2]);
  const Facet fb(b[0], b[1], b[2]);
  const Shared s = shared_corners(ta, tb);
  switch (s.count) {
    case 0:
      return CGAL::do_intersect(fa, fb);
    case 1:
      // Beyond the shared corner, they meet only when the side opposite to it, of one triangle, meets the other
      // triangle.
      return CGAL::do_intersect(fb, Segment(a[s.in_a[1]], a[s.in_a[2]])) ||
             CGAL::do_intersect(fa, Segment(b[s.in_b[1]], b[s.in_b[2]]));
    case 2: {
      // Beyond the shared side, they overlap only when they are folded flat onto each other.
      const FacetPoint& p = a[s.in_a[0]];
      const FacetPoint& q = a[s.in_a[1]];
      const FacetPoint& r = a[s.in_a[2]];
      const FacetPoint& t = b[s.in_b[2]];
      return CGAL::coplanar(p, q, r, t) && CGAL::coplanar_orientation(p, q, r, t) == CGAL::POSITIVE;
    }
    default:
      return true;  // both are the same triangle
  }
}

}  // namespace

core::Result<std::uint64_t> self_intersecting_pairs(const core::Mesh& mesh) {
  std::vector<Corners> corners;
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners c;
    for (int k = 0; k < 3; ++k) {
      const core::Vec3 v = mesh.vertices[mesh.triangles[t][k]];
      c[k] = FacetPoint(double{v.x}, double{v.y}, double{v.z});
    }
    corners.push_back(c);
    boxes.emplace_back(c[0].bbox() + c[1].bbox() + c[2].bbox(), t);
  }
  try {
    std::uint64_t pairs = 0;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& p, const Box& q) {
      const std::uint32_t i = p.info();
      const std::uint32_t j = q.info();
      pairs += cross(mesh.triangles[i], mesh.triangles[j], corners[i], corners[j]) ? 1 : 0;
    });
    return pairs;
  } catch (const std::exception& e) {
    return core::Error{std::string("self-intersections cannot be counted: ") + e.what(), "mesh " + mesh.name,
                       "repair the mesh", core::Exit::kInternal};
  }
}

}  // namespace broadside::datasets
