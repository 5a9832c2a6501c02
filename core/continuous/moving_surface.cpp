#include "core/continuous/moving_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/continuous/surface_view.hpp"

namespace broadside::continuous {
namespace {

bool is_finite(core::Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

core::Vec3d to_double(core::Vec3 p) {
  return {p.x, p.y, p.z};
}

std::array<std::uint32_t, 2> edge_between(std::uint32_t p, std::uint32_t q) {
  return p < q ? std::array{p, q} : std::array{q, p};
}

std::uint64_t key_of(std::array<std::uint32_t, 2> edge) {
  return (static_cast<std::uint64_t>(edge[0]) << 32) | edge[1];
}

std::string number(std::uint64_t n) {
  return std::to_string(n);
}

}  // namespace

core::Status check(const MovingSurface& s) {
  if (s.start.size() != s.end.size())
    return core::Error{number(s.start.size()) + " vertices at the start and " + number(s.end.size()) + " at the end",
                       s.name, "give both states of one mesh"};
  if (!s.part.empty() && s.part.size() != s.triangles.size())
    return core::Error{number(s.part.size()) + " parts of " + number(s.triangles.size()) + " triangles", s.name,
                       "give each triangle the part that it belongs to"};
  for (std::size_t k = 0; k < s.start.size(); ++k)
    if (!is_finite(s.start[k]) || !is_finite(s.end[k]))
      return core::Error{"a coordinate that is not finite", s.name + ", vertex " + number(k), "mend the mesh"};
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (const std::uint32_t v : s.triangles[t])
      if (v >= s.start.size())
        return core::Error{"there is no vertex " + number(v), s.name + ", triangle " + number(t), "mend the mesh"};
  return core::Done{};
}

core::Result<MovingSurface> surface_between(const core::Mesh& start, const core::Mesh& end) {
  const std::string advice =
      "give both states of one mesh, with vertices and triangles in the same order; a binary PLY keeps them";
  if (start.vertices.size() != end.vertices.size() || start.triangles.size() != end.triangles.size())
    return core::Error{number(start.vertices.size()) + " vertices and " + number(start.triangles.size()) +
                           " triangles at the start, " + number(end.vertices.size()) + " and " +
                           number(end.triangles.size()) + " at the end",
                       start.name + " and " + end.name, advice};
  for (std::size_t t = 0; t < start.triangles.size(); ++t)
    if (start.triangles[t] != end.triangles[t])
      return core::Error{"triangle " + number(t) + " has other vertices at the end", start.name + " and " + end.name,
                         advice};
  MovingSurface surface;
  surface.name = start.name;
  surface.start = start.vertices;
  surface.end = end.vertices;
  surface.triangles = start.triangles;
  if (core::Status s = check(surface); !s) return s.error();
  return surface;
}

SurfaceFeatures features_of(const MovingSurface& surface) {
  SurfaceFeatures out;
  out.owner_of_vertex.assign(surface.start.size(), kNoTriangle);
  out.edges_of.resize(surface.triangles.size());
  // Each edge of each triangle, sorted by its vertices and then by triangle: the first of equal edges owns the edge.
  struct Use {
    std::uint64_t edge;
    std::uint64_t corner;  // 3 times the triangle, and which of its edges
  };
  std::vector<Use> uses;
  uses.reserve(3 * surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const core::Triangle& corners = surface.triangles[t];
      auto& owner = out.owner_of_vertex[corners[k]];
      owner = std::min(owner, t);
      uses.push_back({key_of(edge_between(corners[k], corners[(k + 1) % 3])), 3 * std::uint64_t{t} + k});
    }
  std::sort(uses.begin(), uses.end(),
            [](const Use& a, const Use& b) { return std::pair(a.edge, a.corner) < std::pair(b.edge, b.corner); });
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const Use& use = uses[k];
    if (k == 0 || uses[k - 1].edge != use.edge) {
      out.edges.push_back({static_cast<std::uint32_t>(use.edge >> 32), static_cast<std::uint32_t>(use.edge)});
      out.owner_of_edge.push_back(static_cast<std::uint32_t>(use.corner / 3));
    }
    out.edges_of[use.corner / 3][use.corner % 3] = static_cast<std::uint32_t>(out.edges.size() - 1);
  }
  return out;
}

std::uint64_t digest_of(const FeaturePairs& pairs) {
  std::uint64_t sum = 0;
  for (const FeaturePair p : pairs.vertex_face) sum += feature_digest(FeatureKind::kVertexFace, p);
  for (const FeaturePair p : pairs.edge_edge) sum += feature_digest(FeatureKind::kEdgeEdge, p);
  return sum;
}

std::array<std::uint32_t, 4> points_of(const MovingSurface& surface, const SurfaceFeatures& features, FeatureKind kind,
                                       FeaturePair pair) {
  if (kind == FeatureKind::kVertexFace) {
    const core::Triangle& face = surface.triangles[pair.second];
    return {pair.first, face[0], face[1], face[2]};
  }
  const auto& e = features.edges[pair.first];
  const auto& f = features.edges[pair.second];
  return {e[0], e[1], f[0], f[1]};
}

MovingFeatures moving_features(const MovingSurface& surface, const SurfaceFeatures& features, FeatureKind kind,
                               FeaturePair pair) {
  MovingFeatures out;
  out.kind = kind;
  const auto points = points_of(surface, features, kind, pair);
  for (int k = 0; k < 4; ++k) {
    out.start[k] = to_double(surface.start[points[k]]);
    out.end[k] = to_double(surface.end[points[k]]);
  }
  return out;
}

std::vector<VertexPath> vertex_paths(const MovingSurface& surface) {
  std::vector<VertexPath> paths;
  paths.reserve(surface.start.size());
  for (std::size_t v = 0; v < surface.start.size(); ++v) {
    const core::Vec3 from = surface.start[v];
    const core::Vec3 to = surface.end[v];
    paths.push_back({{from.x, from.y, from.z, 0.0F}, {to.x, to.y, to.z, 0.0F}});
  }
  return paths;
}

}  // namespace broadside::continuous
