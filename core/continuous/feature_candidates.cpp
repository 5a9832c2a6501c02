#include "core/continuous/feature_candidates.hpp"

#include <algorithm>

namespace broadside::continuous {
namespace {

core::Box box_of(const core::Box& a, const core::Box& b) {
  return core::grown(core::grown(a, b.min), b.max);
}

bool share(const core::Triangle& face, std::uint32_t vertex) {
  return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

bool share(const std::array<std::uint32_t, 2>& e, const std::array<std::uint32_t, 2>& f) {
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

}  // namespace

std::vector<core::Box> swept_boxes(const MovingSurface& surface) {
  std::vector<core::Box> boxes;
  boxes.reserve(surface.triangles.size());
  for (const core::Triangle& t : surface.triangles) {
    core::Box box = core::empty_box();
    for (const std::uint32_t v : t) box = core::grown(core::grown(box, surface.start[v]), surface.end[v]);
    boxes.push_back(box);
  }
  return boxes;
}

CandidateFinder::CandidateFinder(const MovingSurface& surface, const SurfaceFeatures& features)
    : surface_(surface), features_(features), faces_(swept_boxes(surface)), owned_(surface.triangles.size()) {
  for (std::size_t v = 0; v < surface.start.size(); ++v)
    vertices_.push_back(swept_box(surface.start[v], surface.end[v]));
  for (const auto& e : features.edges) edges_.push_back(box_of(vertices_[e[0]], vertices_[e[1]]));
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (unsigned k = 0; k < 3; ++k) {
      if (features.owner_of_vertex[surface.triangles[t][k]] == t) owned_[t] |= 1U << k;
      if (features.owner_of_edge[features.edges_of[t][k]] == t) owned_[t] |= 8U << k;
    }
}

bool CandidateFinder::may_meet(std::uint32_t triangle, std::uint32_t other) const {
  return surface_.parts_meet_themselves || (!surface_.part.empty() && surface_.part[triangle] != surface_.part[other]);
}

void CandidateFinder::add_vertices(std::uint32_t owner, std::uint32_t face, FeaturePairs& out) const {
  for (unsigned k = 0; k < 3; ++k) {
    const std::uint32_t v = surface_.triangles[owner][k];
    if ((owned_[owner] & (1U << k)) != 0 && core::overlaps(vertices_[v], faces_[face]) &&
        !share(surface_.triangles[face], v))
      out.vertex_face.push_back({v, face});
  }
}

void CandidateFinder::add_edges(std::uint32_t owner, std::uint32_t other, FeaturePairs& out) const {
  for (unsigned k = 0; k < 3; ++k) {
    if ((owned_[owner] & (8U << k)) == 0) continue;
    const std::uint32_t e = features_.edges_of[owner][k];
    for (unsigned j = 0; j < 3; ++j) {
      const std::uint32_t f = features_.edges_of[other][j];
      if ((owned_[other] & (8U << j)) != 0 && core::overlaps(edges_[e], edges_[f]) &&
          !share(features_.edges[e], features_.edges[f]))
        out.edge_edge.push_back({std::min(e, f), std::max(e, f)});
    }
  }
}

void CandidateFinder::add(std::span<const core::Pair> triangles, FeaturePairs& out) const {
  for (const core::Pair p : triangles) {
    if (!may_meet(p.i, p.j)) continue;
    add_vertices(p.i, p.j, out);
    add_vertices(p.j, p.i, out);
    add_edges(p.i, p.j, out);
  }
}

FeaturePairs CandidateFinder::try_all() const {
  FeaturePairs out;
  const auto& vertex_owner = features_.owner_of_vertex;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v)
    for (std::uint32_t t = 0; t < faces_.size() && vertex_owner[v] != kNoTriangle; ++t)
      if (may_meet(vertex_owner[v], t) && !share(surface_.triangles[t], v) && core::overlaps(vertices_[v], faces_[t]))
        out.vertex_face.push_back({v, t});
  const auto& edge_owner = features_.owner_of_edge;
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for (std::uint32_t f = e + 1; f < edges_.size(); ++f)
      if (may_meet(edge_owner[e], edge_owner[f]) && !share(features_.edges[e], features_.edges[f]) &&
          core::overlaps(edges_[e], edges_[f]))
        out.edge_edge.push_back({e, f});
  return out;
}

}  // namespace broadside::continuous
