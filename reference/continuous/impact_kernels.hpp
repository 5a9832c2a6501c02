// First touches of many queries: one text (impact_kernel.hpp), compiled for several instruction sets; all give the same
// bits.
#pragma once

#include <cstdint>

#include "reference/continuous/impact_source.hpp"

namespace broadside::reference {

// Of a query without a touch.
inline constexpr double kNoTouch = 2.0;

// Queries first to last - 1 of a source, all of one kind: times[k] is that of query k. Of those that touch after
// `limit` it may be kNoTouch.
template <typename Source>
using ImpactKernel = void (*)(const Source& source, std::uint32_t first, std::uint32_t last, double limit,
                              double* times);

// A query by itself, and one that a kernel leaves to directions that turn. In a source without special instructions, so
// that no other one compiles these functions with them, of which the linker keeps one.
template <int kCount, typename Source>
double impact_alone(const Source& source, std::uint32_t query);
template <int kCount, typename Source>
double impact_by_turning(const Source& source, std::uint32_t query, double from);

struct ImpactKernels {
  ImpactKernel<GivenFeatures> given_vertex_face;
  ImpactKernel<GivenFeatures> given_edge_edge;
  ImpactKernel<SurfacePairs<continuous::FeatureKind::kVertexFace>> vertex_face;
  ImpactKernel<SurfacePairs<continuous::FeatureKind::kEdgeEdge>> edge_edge;
};

// Queries side by side. This machine may have neither of the last two.
enum class Width { kWidest, kOne, kFour, kEight };

// As wide as was asked for, or as this machine can.
const ImpactKernels& impact_kernels(Width width);
// What that is: 1, 4 or 8.
int lanes_of(Width width);

extern const ImpactKernels kScalarKernels;
#ifdef BROADSIDE_HAS_IMPACT_LANES
extern const ImpactKernels kAvx2Kernels;
extern const ImpactKernels kAvx512Kernels;
#endif

}  // namespace broadside::reference
