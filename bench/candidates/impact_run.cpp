#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "bench/candidates/candidate_race.hpp"
#include "reference/continuous/surface_impacts.hpp"

namespace broadside::bench {
namespace {

// The least time of several runs counts: other work on the machine can only add to a time.
constexpr int kRuns = 3;

double least_seconds(const auto& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

}  // namespace

core::Status time_impacts(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features,
                          const continuous::FeaturePairs& pairs, CandidateRow& row) {
  using continuous::FeatureKind;
  const reference::SurfaceImpacts impacts(surface, features);
  std::vector<double> faces(pairs.vertex_face.size());
  std::vector<double> edges(pairs.edge_edge.size());
  row.impacts_s = least_seconds([&] {
    impacts.times(FeatureKind::kVertexFace, pairs.vertex_face, faces);
    impacts.times(FeatureKind::kEdgeEdge, pairs.edge_edge, edges);
  });
  reference::EarliestImpact earliest;
  row.earliest_s = least_seconds([&] { earliest = impacts.earliest(pairs); });
  double least = reference::kNoTouch;
  for (const auto* times : {&faces, &edges})
    for (const double time : *times) {
      row.touching += time <= 1.0 ? 1 : 0;
      least = std::min(least, time);
    }
  row.impacts = reference::impact_digest(pairs, faces, edges);
  row.first_touch = earliest.touches ? earliest.time : reference::kNoTouch;
  if (row.first_touch != least)
    return core::Error{
        fmt::format("the earliest touch is at {:.17g}, and the least of all at {:.17g}", row.first_touch, least),
        surface.name, "report it with this command", core::Exit::kInternal};
  return core::Done{};
}

}  // namespace broadside::bench
