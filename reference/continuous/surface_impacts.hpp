// First touches of the features of a moving surface, or of given features, on all cores.
#pragma once

#include <span>
#include <vector>

#include "core/continuous/moving_surface.hpp"
#include "reference/continuous/impact_kernels.hpp"

namespace broadside::reference {

struct ImpactSettings {
  Width width = Width::kWidest;
  unsigned workers = 0;  // 0 = one a core
};

// The earliest of many impacts. Among equally early ones, that of the least kind and pair.
struct EarliestImpact {
  bool touches = false;
  double time = 1.0;
  continuous::FeatureKind kind = continuous::FeatureKind::kVertexFace;
  continuous::FeaturePair pair;

  friend bool operator==(const EarliestImpact&, const EarliestImpact&) = default;
};

// times[k] is the first touch of features[k], kNoTouch where there is none.
void first_impacts(std::span<const continuous::MovingFeatures> features, std::span<double> times,
                   const ImpactSettings& settings = {});

// Sum modulo 2^64 over the candidates and the bits of their times, so any order gives the same digest.
std::uint64_t impact_digest(const continuous::FeaturePairs& pairs, std::span<const double> vertex_face,
                            std::span<const double> edge_edge);

class SurfaceImpacts {
 public:
  // The surface and its features must outlive this object.
  SurfaceImpacts(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features);

  // The result of first_impact for each pair, bit for bit, whatever the settings.
  void times(continuous::FeatureKind kind, std::span<const continuous::FeaturePair> pairs, std::span<double> times,
             const ImpactSettings& settings = {}) const;

  // The earliest of all: a query ends once it can no longer be the earliest.
  [[nodiscard]] EarliestImpact earliest(const continuous::FeaturePairs& pairs,
                                        const ImpactSettings& settings = {}) const;

 private:
  template <continuous::FeatureKind kKind>
  [[nodiscard]] SurfacePairs<kKind> source(std::span<const continuous::FeaturePair> pairs) const;

  std::vector<continuous::VertexPath> paths_;
  continuous::SurfaceView view_;
};

}  // namespace broadside::reference
