#include "reference/continuous/impact_kernels.hpp"

#include "core/continuous/feature_impact.hpp"

namespace broadside::reference {

using continuous::FeatureKind, continuous::kEdgeCount, continuous::kFaceCount;

template <int kCount, typename Source>
double impact_alone(const Source& source, std::uint32_t query) {
  const continuous::Impact found = continuous::first_impact_of<kCount>(source.at(query));
  return found.touches ? found.time : kNoTouch;
}

template <int kCount, typename Source>
double impact_by_turning(const Source& source, std::uint32_t query, double from) {
  const auto found = continuous::turning_search(continuous::differences_of<kCount>(source.at(query)), from);
  return found.touches ? found.time : kNoTouch;
}

namespace {

template <int kCount, typename Source>
void one_by_one(const Source& source, std::uint32_t first, std::uint32_t last, double /*limit*/, double* times) {
  for (std::uint32_t k = first; k < last; ++k) times[k] = impact_alone<kCount>(source, k);
}

#ifdef BROADSIDE_HAS_IMPACT_LANES
bool has_four() {
  return __builtin_cpu_supports("avx2") != 0;
}
bool has_eight() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
}
#endif

}  // namespace

const ImpactKernels kScalarKernels{one_by_one<kFaceCount, GivenFeatures>, one_by_one<kEdgeCount, GivenFeatures>,
                                   one_by_one<kFaceCount, SurfacePairs<FeatureKind::kVertexFace>>,
                                   one_by_one<kEdgeCount, SurfacePairs<FeatureKind::kEdgeEdge>>};

int lanes_of(Width width) {
#ifdef BROADSIDE_HAS_IMPACT_LANES
  if ((width == Width::kWidest || width == Width::kEight) && has_eight()) return 8;
  if (width != Width::kOne && has_four()) return 4;
#endif
  static_cast<void>(width);
  return 1;
}

const ImpactKernels& impact_kernels(Width width) {
#ifdef BROADSIDE_HAS_IMPACT_LANES
  if (lanes_of(width) == 8) return kAvx512Kernels;
  if (lanes_of(width) == 4) return kAvx2Kernels;
#endif
  return kScalarKernels;
}

#define BROADSIDE_ALONE(count, source)                               \
  template double impact_alone<count>(const source&, std::uint32_t); \
  template double impact_by_turning<count>(const source&, std::uint32_t, double);
BROADSIDE_ALONE(kFaceCount, GivenFeatures)
BROADSIDE_ALONE(kEdgeCount, GivenFeatures)
BROADSIDE_ALONE(kFaceCount, SurfacePairs<FeatureKind::kVertexFace>)
BROADSIDE_ALONE(kEdgeCount, SurfacePairs<FeatureKind::kEdgeEdge>)
#undef BROADSIDE_ALONE

}  // namespace broadside::reference
