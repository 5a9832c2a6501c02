// What kernels of continuous collision read and write.
#pragma once

#include <cstdint>

#include "core/continuous/surface_view.hpp"
#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// In a query that the first look left: it was not looked at, since its coordinates must be scaled first.
inline constexpr std::uint32_t kUnlooked = 0x80000000U;

// A touch.
struct ImpactHit {
  std::uint32_t query;
  std::uint32_t kind;
  double time;
};

struct ImpactCounts {
  std::uint32_t left;                // queries that the first look left; 0 before it
  std::uint32_t hits;                // touches that were as early as any before
  unsigned long long earliest_bits;  // of the earliest time so far: bits of times above zero are in the order of times
};

struct ImpactView {
  continuous::SurfaceView surface;
  continuous::FeatureKind kind;
  const continuous::FeaturePair* pairs;
  std::uint32_t first;  // queries of this launch: first to last - 1
  std::uint32_t last;
  std::uint32_t* left;  // room for last - first
  ImpactHit* hits;      // of the earliest time alone; those past the capacity are counted and not written
  std::uint32_t hit_capacity;
  ImpactCounts* counts;
  double* times;  // of each pair; null: the earliest time alone is asked for, and queries end at it
};

// Of a query without a touch.
inline constexpr double kNoTouch = 2.0;

// The first look at every query of the view, and then the search for those that it left.
core::Status launch_impacts(const ImpactView& view, std::uint32_t multiprocessors, StreamHandle stream);

core::Result<std::uint32_t> multiprocessor_count();

}  // namespace broadside::gpu
