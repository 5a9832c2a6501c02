#include "reference/continuous/surface_impacts.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using continuous::FeatureKind;
using continuous::FeaturePair;

// Queries per task: some hundred microseconds of work.
constexpr std::size_t kImpactGrain = 4096;

// Calls work(first, last) for parts of `count`.
void in_parts(std::size_t count, unsigned workers, const auto& work) {
  const std::size_t tasks = (count + kImpactGrain - 1) / kImpactGrain;
  tbb::task_arena arena(worker_count(workers));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, tasks,
                      [&](std::size_t k) { work(k * kImpactGrain, std::min(count, (k + 1) * kImpactGrain)); });
  });
}

template <FeatureKind kKind>
ImpactKernel<SurfacePairs<kKind>> kernel(Width width) {
  const ImpactKernels& all = impact_kernels(width);
  if constexpr (kKind == FeatureKind::kVertexFace)
    return all.vertex_face;
  else
    return all.edge_edge;
}

bool is_before(const EarliestImpact& a, const EarliestImpact& b) {
  if (a.touches != b.touches) return a.touches;
  if (a.time != b.time) return a.time < b.time;
  return a.kind != b.kind ? a.kind < b.kind : a.pair < b.pair;
}

// The earliest impact of pairs of one kind. limit: the earliest time so far of all threads, at which each thread ends
// its queries.
template <FeatureKind kKind>
EarliestImpact earliest_of(const SurfacePairs<kKind>& source, std::size_t count, const ImpactSettings& settings,
                           std::atomic<double>& limit) {
  tbb::enumerable_thread_specific<EarliestImpact> found;
  in_parts(count, settings.workers, [&](std::size_t first, std::size_t last) {
    std::array<double, kImpactGrain> times;
    SurfacePairs<kKind> part = source;
    part.pairs += first;
    const auto size = static_cast<std::uint32_t>(last - first);
    kernel<kKind>(settings.width)(part, 0, size, limit.load(std::memory_order_relaxed), times.data());
    EarliestImpact& best = found.local();
    for (std::uint32_t k = 0; k < size; ++k) {
      if (times[k] > 1.0) continue;
      const EarliestImpact one{true, times[k], kKind, part.pairs[k]};
      if (is_before(one, best)) best = one;
    }
    double known = limit.load(std::memory_order_relaxed);
    while (best.touches && best.time < known &&
           !limit.compare_exchange_weak(known, best.time, std::memory_order_relaxed)) {
    }
  });
  EarliestImpact out;
  for (const EarliestImpact& one : found)
    if (is_before(one, out)) out = one;
  return out;
}

}  // namespace

void first_impacts(std::span<const continuous::MovingFeatures> features, std::span<double> times,
                   const ImpactSettings& settings) {
  const ImpactKernels& kernels = impact_kernels(settings.width);
  in_parts(features.size(), settings.workers, [&](std::size_t first, std::size_t last) {
    const GivenFeatures source{features.data() + first};
    const auto size = static_cast<std::uint32_t>(last - first);
    // Queries are handed over in runs of one kind.
    for (std::uint32_t begin = 0; begin < size;) {
      const FeatureKind kind = source.features[begin].kind;
      std::uint32_t end = begin + 1;
      while (end < size && source.features[end].kind == kind) ++end;
      const auto run = kind == FeatureKind::kVertexFace ? kernels.given_vertex_face : kernels.given_edge_edge;
      run(source, begin, end, 1.0, times.data() + first);
      begin = end;
    }
  });
}

std::uint64_t impact_digest(const continuous::FeaturePairs& pairs, std::span<const double> vertex_face,
                            std::span<const double> edge_edge) {
  std::uint64_t sum = 0;
  const auto add = [&](FeatureKind kind, const std::vector<FeaturePair>& of_kind, std::span<const double> times) {
    for (std::size_t k = 0; k < of_kind.size(); ++k)
      sum += core::splitmix64(continuous::feature_digest(kind, of_kind[k]) + std::bit_cast<std::uint64_t>(times[k]));
  };
  add(FeatureKind::kVertexFace, pairs.vertex_face, vertex_face);
  add(FeatureKind::kEdgeEdge, pairs.edge_edge, edge_edge);
  return sum;
}

SurfaceImpacts::SurfaceImpacts(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features)
    : paths_(continuous::vertex_paths(surface)),
      view_{paths_.data(), surface.triangles.data()->data(), features.edges.data()->data()} {}

template <FeatureKind kKind>
SurfacePairs<kKind> SurfaceImpacts::source(std::span<const FeaturePair> pairs) const {
  return {view_, pairs.data()};
}

void SurfaceImpacts::times(FeatureKind kind, std::span<const FeaturePair> pairs, std::span<double> times,
                           const ImpactSettings& settings) const {
  const auto run = [&]<FeatureKind kKind>(SurfacePairs<kKind> all) {
    in_parts(pairs.size(), settings.workers, [&](std::size_t first, std::size_t last) {
      SurfacePairs<kKind> part = all;
      part.pairs += first;
      kernel<kKind>(settings.width)(part, 0, static_cast<std::uint32_t>(last - first), 1.0, times.data() + first);
    });
  };
  if (kind == FeatureKind::kVertexFace)
    run(source<FeatureKind::kVertexFace>(pairs));
  else
    run(source<FeatureKind::kEdgeEdge>(pairs));
}

EarliestImpact SurfaceImpacts::earliest(const continuous::FeaturePairs& pairs, const ImpactSettings& settings) const {
  std::atomic<double> limit = 1.0;
  const EarliestImpact face =
      earliest_of(source<FeatureKind::kVertexFace>(pairs.vertex_face), pairs.vertex_face.size(), settings, limit);
  const EarliestImpact edge =
      earliest_of(source<FeatureKind::kEdgeEdge>(pairs.edge_edge), pairs.edge_edge.size(), settings, limit);
  return is_before(edge, face) ? edge : face;
}

}  // namespace broadside::reference
