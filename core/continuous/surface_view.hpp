// A moving surface as kernels read it, on host and device: plain pointers, one half of a cache line for each vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "core/continuous/moving_surface.hpp"

namespace broadside::continuous {

// Both positions of a vertex, and a fourth number that is unused.
struct alignas(32) VertexPath {
  float start[4];
  float end[4];
};

std::vector<VertexPath> vertex_paths(const MovingSurface& surface);

struct SurfaceView {
  const VertexPath* paths = nullptr;
  const std::uint32_t* triangles = nullptr;  // three vertices each
  const std::uint32_t* edges = nullptr;      // two vertices each

  // The path of a pair's point, numbered as in MovingFeatures.
  [[nodiscard]] BROADSIDE_HD const VertexPath& path(FeatureKind kind, FeaturePair pair, int point) const {
    if (kind == FeatureKind::kVertexFace)
      return paths[point == 0 ? pair.first : triangles[3 * std::size_t{pair.second} + (point - 1)]];
    return paths[edges[2 * std::size_t{point < 2 ? pair.first : pair.second} + point % 2]];
  }

  [[nodiscard]] BROADSIDE_HD MovingFeatures at(FeatureKind kind, FeaturePair pair) const {
    MovingFeatures f;
    f.kind = kind;
    for (int k = 0; k < 4; ++k) {
      const VertexPath& p = path(kind, pair, k);
      f.start[k] = {p.start[0], p.start[1], p.start[2]};
      f.end[k] = {p.end[0], p.end[1], p.end[2]};
    }
    return f;
  }
};

}  // namespace broadside::continuous
