// What kernels of continuous collision read and write.
#pragma once

#include <cstdint>

#include "core/continuous/surface_view.hpp"
#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// Marks a query that the first look could not decide, because its coordinates must be scaled first.
inline constexpr std::uint32_t kUnlooked = 0x80000000U;

// A touch: its query, kind and time.
struct ImpactHit {
  std::uint32_t query;
  std::uint32_t kind;
  double time;
};

struct ImpactCounts {
  std::uint32_t left;                // how many queries the first look left open; 0 before it
  std::uint32_t hits;                // how many touches were as early as any found before
  unsigned long long earliest_bits;  // bits of the earliest time so far; bits of positive times order as times do
};

struct ImpactView {
  continuous::SurfaceView surface;
  continuous::FeatureKind kind;
  const continuous::FeaturePair* pairs;
  std::uint32_t first;  // queries of this launch: first to last - 1
  std::uint32_t last;
  std::uint32_t* left;  // room for last - first
  ImpactHit* hits;      // if only the earliest time is asked for; those past the capacity are counted, not written
  std::uint32_t hit_capacity;
  ImpactCounts* counts;
  double* times;  // [pairs]; null: only the earliest time is asked for, and queries end at it
};

// The time of a query without a touch.
inline constexpr double kNoTouch = 2.0;

// Launches the first look at every query of the view, and then the search for those that it left open.
core::Status launch_impacts(const ImpactView& view, std::uint32_t multiprocessors, StreamHandle stream);

core::Result<std::uint32_t> multiprocessor_count();

}  // namespace broadside::gpu
