// Where kernels read moving features from: an array of features, or the numbers of features on a surface.
#pragma once

#include <cstdint>

#include "core/continuous/surface_view.hpp"

namespace broadside::reference {

// Reads features as they are given, all of one kind.
struct GivenFeatures {
  using Coordinate = double;
  const continuous::MovingFeatures* features;

  [[nodiscard]] const double* start(std::uint32_t query, int point) const { return &features[query].start[point].x; }
  [[nodiscard]] const double* end(std::uint32_t query, int point) const { return &features[query].end[point].x; }
  [[nodiscard]] continuous::MovingFeatures at(std::uint32_t query) const { return features[query]; }
};

// Reads pairs of features of a surface.
template <continuous::FeatureKind kKind>
struct SurfacePairs {
  using Coordinate = float;
  continuous::SurfaceView surface;
  const continuous::FeaturePair* pairs;

  [[nodiscard]] const float* start(std::uint32_t query, int point) const {
    return surface.path(kKind, pairs[query], point).start;
  }
  [[nodiscard]] const float* end(std::uint32_t query, int point) const {
    return surface.path(kKind, pairs[query], point).end;
  }
  [[nodiscard]] continuous::MovingFeatures at(std::uint32_t query) const { return surface.at(kKind, pairs[query]); }
};

}  // namespace broadside::reference
