// Finds when pairs of moving features first touch, by the formulas of core/continuous/, with a thread for each query. A
// first look decides most queries; those that it leaves open are gathered, so that all threads of a warp have one to
// search.
#pragma once

#include "core/continuous/feature_impact.hpp"
#include "gpu/continuous/impact_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

__device__ inline double time_of_bits(unsigned long long bits) {
  double time;
  memcpy(&time, &bits, sizeof time);
  return time;
}
__device__ inline unsigned long long bits_of_time(double time) {
  unsigned long long bits;
  memcpy(&bits, &time, sizeof bits);
  return bits;
}

// No query needs to search beyond this time. Another thread may lower it meanwhile: that costs extra work, but changes
// no answer.
__device__ inline double limit_of(const ImpactView& view) {
  if (view.times != nullptr) return 1.0;
  return time_of_bits(*static_cast<volatile unsigned long long*>(&view.counts->earliest_bits));
}

template <continuous::FeatureKind kKind>
inline constexpr int kCountOf =
    kKind == continuous::FeatureKind::kVertexFace ? continuous::kFaceCount : continuous::kEdgeCount;

template <continuous::FeatureKind kKind>
__device__ continuous::Differences<double, kCountOf<kKind>> load_differences(const ImpactView& view,
                                                                             std::uint32_t query) {
  const continuous::FeaturePair pair = view.pairs[query];
  continuous::Triple<double> start[4], end[4];
  for (int k = 0; k < 4; ++k) {
    const continuous::VertexPath& path = view.surface.path(kKind, pair, k);
    start[k] = {path.start[0], path.start[1], path.start[2]};
    end[k] = {path.end[0], path.end[1], path.end[2]};
  }
  return continuous::differences<kCountOf<kKind>>(start, end);
}

template <continuous::FeatureKind kKind>
__device__ void look_at_queries(const ImpactView& view) {
  const GridPlaces grid;
  for (std::uint64_t base = view.first + warp_rank(grid) * 32; base < view.last; base += warp_count(grid) * 32) {
    const auto query = static_cast<std::uint32_t>(base + lane());
    bool is_left = false;
    bool is_unlooked = false;
    if (query < view.last) {
      const auto x = load_differences<kKind>(view, query);
      is_unlooked = !continuous::is_of_usual_size(x);
      is_left = is_unlooked || !continuous::is_apart_at_first_look(x);
      if (!is_left && view.times != nullptr) view.times[query] = kNoTouch;
    }
    const unsigned lanes = __ballot_sync(kFullWarp, is_left);
    if (lanes == 0) continue;
    const std::uint32_t place = place_in_warp(lanes, &view.counts->left);
    if (is_left) view.left[place] = is_unlooked ? query | kUnlooked : query;
  }
}

// As first_impact_of, but it may stop at the limit.
template <int kCount>
__device__ double search_query(const continuous::MovingFeatures& features, bool is_unlooked, double limit) {
  const auto x = continuous::differences_of<kCount>(features);
  if (is_unlooked && continuous::is_apart_at_first_look(x)) return kNoTouch;
  const auto found = continuous::search(x, continuous::volume_of(x), limit);
  if (!found.is_open) return found.touches ? found.time : kNoTouch;
  const continuous::Impact alone = continuous::turning_search(x, found.time);
  return alone.touches ? alone.time : kNoTouch;
}

template <continuous::FeatureKind kKind>
__device__ void search_left(const ImpactView& view) {
  const GridPlaces grid;
  const std::uint32_t count = view.counts->left;
  for (std::uint64_t k = grid.rank(); k < count; k += grid.size()) {
    const std::uint32_t query = view.left[k] & ~kUnlooked;
    const bool is_unlooked = (view.left[k] & kUnlooked) != 0;
    const double limit = limit_of(view);
    const double time = search_query<kCountOf<kKind>>(view.surface.at(kKind, view.pairs[query]), is_unlooked, limit);
    if (view.times != nullptr) {
      view.times[query] = time;
    } else if (time <= limit) {
      // A touch as early as the earliest of all is not later than any other when it is found, so it is always noted.
      const unsigned long long before = atomicMin(&view.counts->earliest_bits, bits_of_time(time));
      if (time > time_of_bits(before)) continue;
      const std::uint32_t place = atomicAdd(&view.counts->hits, 1U);
      if (place < view.hit_capacity) view.hits[place] = {query, static_cast<std::uint32_t>(kKind), time};
    }
  }
}

}  // namespace broadside::gpu
