// First touches of many queries: one source (impact_kernel.hpp), compiled for several instruction sets, all of which
// give the same bits.
#pragma once

#include <cstdint>

#include "reference/continuous/impact_source.hpp"

namespace broadside::reference {

// The time of a query without a touch.
inline constexpr double kNoTouch = 2.0;

// Queries first to last - 1 of a source, all of one kind: times[k] is the first touch of query k. For queries that
// touch after `limit` it may be kNoTouch.
template <typename Source>
using ImpactKernel = void (*)(const Source& source, std::uint32_t first, std::uint32_t last, double limit,
                              double* times);

// A query by itself, and one that a kernel leaves to the search by turning directions. Both are in a source that is
// compiled without special instructions: otherwise another source might compile these functions with them, and the
// linker might keep that copy.
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

// How many queries are computed side by side. This machine may lack the last two.
enum class Width { kWidest, kOne, kFour, kEight };

// The kernels of the width that was asked for, or of the widest that this machine has.
const ImpactKernels& impact_kernels(Width width);
// The number of lanes of that width: 1, 4 or 8.
int lanes_of(Width width);

extern const ImpactKernels kScalarKernels;
#ifdef BROADSIDE_HAS_IMPACT_LANES
extern const ImpactKernels kAvx2Kernels;
extern const ImpactKernels kAvx512Kernels;
#endif

}  // namespace broadside::reference
