// First touches of many queries side by side: the source of the kernels, which is compiled once for each instruction
// set.
#pragma once

#include <cstdint>

#include "core/continuous/feature_impact.hpp"
#include "reference/continuous/impact_kernels.hpp"
#include "reference/continuous/impact_source.hpp"

namespace broadside::reference {

// Queries per block. After a first look at a block, the queries that it left are searched before the next block begins,
// while their data are still in the nearest cache.
inline constexpr std::uint32_t kBlock = 256;

template <typename Lanes, int kCount, typename Source>
continuous::Differences<Lanes, kCount> load_differences(const Source& source, const std::uint32_t* queries) {
  continuous::Triple<Lanes> start[4], end[4];
  for (int k = 0; k < 4; ++k) {
    const typename Source::Coordinate* from[Lanes::kWidth];
    const typename Source::Coordinate* to[Lanes::kWidth];
    for (int lane = 0; lane < Lanes::kWidth; ++lane) {
      from[lane] = source.start(queries[lane], k);
      to[lane] = source.end(queries[lane], k);
    }
    start[k] = Lanes::points(from);
    end[k] = Lanes::points(to);
  }
  return continuous::differences<kCount>(start, end);
}

// The queries of a block that the first look could not decide.
struct LeftOver {
  std::uint32_t count = 0;
  std::uint32_t query[kBlock + 16];
};

template <typename Lanes, int kCount, typename Source>
void look(const Source& source, std::uint32_t first, std::uint32_t last, double* times, LeftOver& left) {
  std::uint32_t queries[Lanes::kWidth];
  for (std::uint32_t base = first; base < last; base += Lanes::kWidth) {
    const std::uint32_t count = last - base < Lanes::kWidth ? last - base : Lanes::kWidth;
    for (std::uint32_t k = 0; k < Lanes::kWidth; ++k) queries[k] = base + k < last ? base + k : last - 1;
    const auto x = load_differences<Lanes, kCount>(source, queries);
    const unsigned usual = is_of_usual_size(x).lanes();
    const unsigned apart = is_apart_at_first_look(x).lanes();
    for (std::uint32_t k = 0; k < count; ++k) {
      times[base + k] = kNoTouch;
      // Writes the query always, and advances the count only where the query is left: so there is no branch to
      // mispredict.
      left.query[left.count] = base + k;
      left.count += usual >> k & ~(apart >> k) & 1U;
    }
    if ((usual | ~((1U << count) - 1U)) == ~0U) continue;
    for (std::uint32_t k = 0; k < count; ++k)
      if ((usual >> k & 1U) == 0) times[base + k] = impact_alone<kCount>(source, base + k);
  }
}

template <typename Lanes, int kCount, typename Source>
void search_left(const Source& source, double limit, double* times, LeftOver& left) {
  for (int k = 0; k < Lanes::kWidth && left.count > 0; ++k)  // the last lanes repeat the last query
    left.query[left.count + k] = left.query[left.count - 1];
  double until[Lanes::kWidth];
  for (std::uint32_t base = 0; base < left.count; base += Lanes::kWidth) {
    const auto x = load_differences<Lanes, kCount>(source, left.query + base);
    const auto found = continuous::search(x, continuous::volume_of(x), Lanes(limit));
    const unsigned touching = found.touches.lanes();
    const unsigned open = found.is_open.lanes();
    if ((touching | open) == 0) continue;
    found.time.store(until);
    for (std::uint32_t k = 0; k < Lanes::kWidth && base + k < left.count; ++k) {
      const std::uint32_t query = left.query[base + k];
      if ((touching >> k & 1U) != 0) times[query] = until[k];
      if ((open >> k & 1U) != 0) times[query] = impact_by_turning<kCount>(source, query, until[k]);
    }
  }
}

template <typename Lanes, int kCount, typename Source>
void impacts(const Source& source, std::uint32_t first, std::uint32_t last, double limit, double* times) {
  LeftOver left;
  for (std::uint32_t base = first; base < last; base += kBlock) {
    left.count = 0;
    look<Lanes, kCount>(source, base, last - base < kBlock ? last : base + kBlock, times, left);
    search_left<Lanes, kCount>(source, limit, times, left);
  }
}

template <typename Lanes>
constexpr ImpactKernels kernels_of() {
  using continuous::kEdgeCount, continuous::kFaceCount, continuous::FeatureKind;
  return {impacts<Lanes, kFaceCount, GivenFeatures>, impacts<Lanes, kEdgeCount, GivenFeatures>,
          impacts<Lanes, kFaceCount, SurfacePairs<FeatureKind::kVertexFace>>,
          impacts<Lanes, kEdgeCount, SurfacePairs<FeatureKind::kEdgeEdge>>};
}

}  // namespace broadside::reference
