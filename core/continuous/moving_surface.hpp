// A triangle mesh, or several in one, whose vertices move along straight lines during one step; and its vertices, edges
// and triangles as features. Each feature belongs to one triangle.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/continuous/moving_features.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::continuous {

struct MovingSurface {
  std::string name;
  std::vector<core::Vec3> start;  // one per vertex, m
  std::vector<core::Vec3> end;
  std::vector<core::Triangle> triangles;
  std::vector<std::uint32_t> part;    // one per triangle: the number of its body; empty: all are one body
  bool parts_meet_themselves = true;  // false: two features of one part are no candidates, as in a rigid body
};

// Errors: counts that differ, a coordinate that is not finite, a triangle with a vertex that does not exist.
core::Status check(const MovingSurface& surface);

// The surface that moves from one mesh to the other. Errors: meshes that do not have the same triangles.
core::Result<MovingSurface> surface_between(const core::Mesh& start, const core::Mesh& end);

inline constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

struct SurfaceFeatures {
  std::vector<std::array<std::uint32_t, 2>> edges;            // vertices, the lower number first; sorted
  std::vector<std::array<std::uint32_t, 3>> edges_of;         // of each triangle: between its corners 01, 12, 20
  std::vector<std::uint32_t> owner_of_vertex, owner_of_edge;  // first triangle that has it; kNoTriangle: a stray vertex
};

SurfaceFeatures features_of(const MovingSurface& surface);

// A vertex and a triangle, or two edges, the lower number first.
struct FeaturePair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;

  friend constexpr auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

struct FeaturePairs {
  std::vector<FeaturePair> vertex_face;
  std::vector<FeaturePair> edge_edge;

  [[nodiscard]] std::uint64_t count() const { return vertex_face.size() + edge_edge.size(); }
};

// Sum modulo 2^64 over both kinds, so any order gives the same digest.
BROADSIDE_HD std::uint64_t feature_digest(FeatureKind kind, FeaturePair p) {
  const std::uint64_t key = (static_cast<std::uint64_t>(p.first) << 32) | p.second;
  return core::splitmix64(core::splitmix64(key) + static_cast<std::uint64_t>(kind));
}
std::uint64_t digest_of(const FeaturePairs& pairs);

// The four vertices of a pair, numbered as in MovingFeatures.
std::array<std::uint32_t, 4> points_of(const MovingSurface& surface, const SurfaceFeatures& features, FeatureKind kind,
                                       FeaturePair pair);
MovingFeatures moving_features(const MovingSurface& surface, const SurfaceFeatures& features, FeatureKind kind,
                               FeaturePair pair);

}  // namespace broadside::continuous
