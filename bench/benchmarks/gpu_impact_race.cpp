// Continuous collision on the GPU: first touches of the candidates of a folding sheet and of a moving heap, first the
// earliest touch alone and then all touches. The bits must be those of the CPU. Prints one JSON line for each motion
// and mode: medians over the repetitions, by the device's events.
//   broadside_gpu_impacts [TRIANGLES_OF_SHEET [TRIANGLES_OF_HEAP [REPETITIONS]]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/continuous/feature_candidates.hpp"
#include "datasets/motions/motions.hpp"
#include "gpu/continuous/impact_finder.hpp"
#include "reference/continuous/find_candidates.hpp"
#include "reference/continuous/surface_impacts.hpp"
#include "reference/engines.hpp"

namespace broadside::bench {
namespace {

// A GPU that was idle takes some tenths of a second to reach its clock rate.
constexpr double kWarmUpS = 0.5;
// How many queries one launch has where only the earliest time is asked for: 30 launches for 30 million.
constexpr std::uint32_t kEarliestQueries = 1U << 20U;

bool complain(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return false;
}

core::Result<continuous::FeaturePairs> candidates_of(const continuous::MovingSurface& surface,
                                                     const continuous::SurfaceFeatures& features) {
  const core::EngineRow row = reference::octree_cpu_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  if (!engine) return engine.error();
  core::BroadPhase& broad = *engine.value().broad_phase;
  const auto boxes = continuous::swept_boxes(surface);
  if (core::Status s = broad.load(boxes, std::vector<std::uint8_t>(boxes.size())); !s) return s.error();
  if (core::Status s = broad.find(); !s) return s.error();
  auto pairs = broad.read_back();
  if (!pairs) return pairs.error();
  return reference::find_candidates({surface, features}, pairs.value().pairs);
}

struct Times {
  double median_ms = 0.0;
  double least_ms = 0.0;
  double most_ms = 0.0;
};

core::Result<Times> measure(const gpu::ImpactFinder& finder, int repetitions,
                            const std::function<core::Status()>& find) {
  for (double spent_s = 0.0; spent_s < kWarmUpS; spent_s += 1e-5 + finder.seconds())
    if (core::Status s = find(); !s) return s.error();
  std::vector<double> ms;
  for (int k = 0; k < repetitions; ++k) {
    if (core::Status s = find(); !s) return s.error();
    ms.push_back(finder.seconds() * 1e3);
  }
  std::sort(ms.begin(), ms.end());
  return Times{ms[ms.size() / 2], ms.front(), ms.back()};
}

void print(const std::string& motion, const char* mode, std::uint64_t candidates, const Times& t,
           const std::string& more) {
  std::printf(
      "{\"motion\": \"%s\", \"mode\": \"%s\", \"candidates\": %llu, \"ms\": %.4f, \"least_ms\": %.4f, \"most_ms\": %.4f, "
      "\"candidates_per_s\": %.4g, %s}\n",
      motion.c_str(), mode, static_cast<unsigned long long>(candidates), t.median_ms, t.least_ms, t.most_ms,
      static_cast<double>(candidates) / t.median_ms * 1e3, more.c_str());
  std::fflush(stdout);
}

bool race(const std::string& motion, int repetitions) {
  auto surface = datasets::make_motion(motion);
  if (!surface) return complain(surface.error());
  const auto features = continuous::features_of(surface.value());
  auto pairs = candidates_of(surface.value(), features);
  if (!pairs) return complain(pairs.error());
  const std::uint64_t count = pairs.value().count();

  gpu::ImpactFinder all;
  if (core::Status s = all.load(surface.value(), features, pairs.value()); !s) return complain(s.error());
  auto all_times = measure(all, repetitions, [&] { return all.find_times(); });
  if (!all_times) return complain(all_times.error());
  auto times = all.read_back();
  if (!times) return complain(times.error());

  gpu::ImpactFinder first({kEarliestQueries});
  if (core::Status s = first.load(surface.value(), features, pairs.value()); !s) return complain(s.error());
  gpu::FirstHit hit;
  auto first_times = measure(first, repetitions, [&]() -> core::Status {
    auto found = first.find_earliest();
    if (!found) return found.error();
    hit = found.value();
    return core::Done{};
  });
  if (!first_times) return complain(first_times.error());

  // The CPU's answers, with which the bits are compared.
  const reference::SurfaceImpacts on_cpu(surface.value(), features);
  std::vector<double> faces(pairs.value().vertex_face.size()), edges(pairs.value().edge_edge.size());
  on_cpu.times(continuous::FeatureKind::kVertexFace, pairs.value().vertex_face, faces);
  on_cpu.times(continuous::FeatureKind::kEdgeEdge, pairs.value().edge_edge, edges);
  const std::uint64_t digest =
      reference::impact_digest(pairs.value(), times.value().vertex_face, times.value().edge_edge);
  const bool has_same_bits = digest == reference::impact_digest(pairs.value(), faces, edges);
  const reference::EarliestImpact least = on_cpu.earliest(pairs.value());
  const bool has_same_hit =
      least.touches == hit.touches && least.time == hit.time && least.kind == hit.kind && least.pair == hit.pair;
  const auto touching = [](const std::vector<double>& of_kind) {
    return std::count_if(of_kind.begin(), of_kind.end(), [](double t) { return t <= 1.0; });
  };
  char text[200];
  std::snprintf(text, sizeof text, "\"touching\": %lld, \"digest\": \"0x%016llx\", \"same_bits_as_cpu\": %s",
                static_cast<long long>(touching(faces) + touching(edges)), static_cast<unsigned long long>(digest),
                has_same_bits ? "true" : "false");
  print(motion, "all", count, all_times.value(), text);
  std::snprintf(text, sizeof text, "\"first_touch\": %.17g, \"same_as_cpu\": %s", hit.time,
                has_same_hit ? "true" : "false");
  print(motion, "earliest", count, first_times.value(), text);
  return has_same_bits && has_same_hit;
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  const std::string sheet = count > 1 ? given[1] : "4300000";
  const std::string heap = count > 2 ? given[2] : "7000000";
  const int repetitions = count > 3 ? std::max(1, std::atoi(given[3])) : 30;
  bool is_good = broadside::bench::race("folding-sheet:" + sheet, repetitions);
  is_good = broadside::bench::race("moving-heap:" + heap, repetitions) && is_good;
  return is_good ? 0 : 1;
}
