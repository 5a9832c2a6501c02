// Candidates of continuous collision: pairs of features whose boxes, swept over the step, overlap. They are found from
// the pairs of triangles with overlapping swept boxes that a broad phase reports.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/continuous/moving_surface.hpp"
#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside::continuous {

// The box that contains a point during the whole step: exactly the box of its two end positions.
BROADSIDE_HD core::Box swept_box(core::Vec3 start, core::Vec3 end) {
  return core::grown(core::Box{start, start}, end);
}

// One swept box per triangle.
std::vector<core::Box> swept_boxes(const MovingSurface& surface);

class CandidateFinder {
 public:
  // Both must live as long as the finder.
  CandidateFinder(const MovingSurface& surface, const SurfaceFeatures& features);

  // Appends the candidates of these pairs of triangles. A vertex and a triangle, or two edges, are a candidate when
  // their swept boxes overlap, they share no vertex, and their parts may meet. Each belongs to the pair of triangles
  // that own the two features, so the pairs of all overlapping triangles give each candidate once.
  void add(std::span<const core::Pair> triangles, FeaturePairs& out) const;

  // Finds the candidates among all pairs of features, without a broad phase: for tests.
  [[nodiscard]] FeaturePairs try_all() const;

 private:
  [[nodiscard]] bool may_meet(std::uint32_t triangle, std::uint32_t other) const;
  void add_vertices(std::uint32_t owner, std::uint32_t face, FeaturePairs& out) const;
  void add_edges(std::uint32_t owner, std::uint32_t other, FeaturePairs& out) const;

  const MovingSurface& surface_;
  const SurfaceFeatures& features_;
  std::vector<core::Box> faces_, edges_, vertices_;
  std::vector<std::uint8_t> owned_;  // one per triangle: bit k = it owns its corner k; bit 3 + k = its edge k
};

}  // namespace broadside::continuous
