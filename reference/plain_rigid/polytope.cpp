#include "reference/plain_rigid/polytope.hpp"

#include <algorithm>
#include <map>

namespace broadside::reference::plain {
namespace {

// Triangles of one plane have normals that differ by the rounding of their float corners alone.
constexpr double kSamePlane = 1e-5;
constexpr double kParallel = 1e-9;

void add_edges(Polytope& shape) {
  for (const PolytopeFace& face : shape.faces)
    for (std::size_t k = 0; k < face.corners.size(); ++k)
      shape.edges.push_back(std::minmax(face.corners[k], face.corners[(k + 1) % face.corners.size()]));
  std::sort(shape.edges.begin(), shape.edges.end());
  shape.edges.erase(std::unique(shape.edges.begin(), shape.edges.end()), shape.edges.end());
  for (const auto& [i, j] : shape.edges) {
    const Vec d = shape.vertices[j] - shape.vertices[i];
    const Vec along = (1.0 / length(d)) * d;
    const bool is_known = std::any_of(shape.directions.begin(), shape.directions.end(),
                                      [&](Vec q) { return length(cross(q, along)) <= kParallel; });
    if (!is_known) shape.directions.push_back(along);
  }
}

// The boundary of a group of triangles: edges whose reverse belongs to no triangle of the group.
std::vector<std::uint32_t> rim_of(const std::vector<core::Triangle>& group) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const core::Triangle& t : group)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      const bool is_inner = std::any_of(group.begin(), group.end(), [&](const core::Triangle& other) {
        for (std::size_t e = 0; e < 3; ++e)
          if (other[e] == to && other[(e + 1) % 3] == from) return true;
        return false;
      });
      if (!is_inner) next[from] = to;
    }
  std::vector<std::uint32_t> rim;
  if (next.empty()) return rim;
  for (std::uint32_t at = next.begin()->first; rim.size() < next.size(); at = next[at]) rim.push_back(at);
  return rim;
}

}  // namespace

Polytope box_polytope(Vec h) {
  Polytope shape;
  for (unsigned corner = 0; corner < 8; ++corner)
    shape.vertices.push_back(
        {(corner & 1U) != 0 ? h.x : -h.x, (corner & 2U) != 0 ? h.y : -h.y, (corner & 4U) != 0 ? h.z : -h.z});
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t bit = 1U << static_cast<unsigned>(axis);
    const std::uint32_t u = 1U << static_cast<unsigned>((axis + 1) % 3);
    const std::uint32_t w = 1U << static_cast<unsigned>((axis + 2) % 3);
    shape.faces.push_back({{bit, bit | u, bit | u | w, bit | w}, axis_of(axis)});
    shape.faces.push_back({{0, w, u | w, u}, -axis_of(axis)});
  }
  add_edges(shape);
  return shape;
}

Polytope polytope_of(const core::Mesh& mesh) {
  Polytope shape;
  for (const core::Vec3 v : mesh.vertices) shape.vertices.push_back({v.x, v.y, v.z});
  struct Group {
    Vec normal;
    std::vector<core::Triangle> triangles;
  };
  std::vector<Group> groups;
  for (const core::Triangle& t : mesh.triangles) {
    const Vec a = shape.vertices[t[0]];
    const Vec n = cross(shape.vertices[t[1]] - a, shape.vertices[t[2]] - a);
    const double size = length(n);
    if (!(size > 0.0)) continue;
    const Vec unit = (1.0 / size) * n;
    const auto known = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& g) { return length(g.normal - unit) <= kSamePlane; });
    if (known == groups.end())
      groups.push_back({unit, {t}});
    else
      known->triangles.push_back(t);
  }
  for (const Group& g : groups) shape.faces.push_back({rim_of(g.triangles), g.normal});
  add_edges(shape);
  return shape;
}

Polytope placed(const Polytope& shape, const Mat& r, Vec origin) {
  Polytope out = shape;
  for (Vec& v : out.vertices) v = origin + r * v;
  for (PolytopeFace& f : out.faces) f.normal = r * f.normal;
  for (Vec& d : out.directions) d = r * d;
  return out;
}

}  // namespace broadside::reference::plain
