#include "bench/benchmarks/feature_queries.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/continuous/feature_candidates.hpp"
#include "core/exact/feature_touch.hpp"
#include "core/pair.hpp"
#include "datasets/motions/motions.hpp"
#include "datasets/random.hpp"
#include "reference/continuous/find_candidates.hpp"
#include "reference/engines.hpp"
#include "reference/motion/motion_engines.hpp"

namespace broadside::bench {
namespace {

using continuous::MovingFeatures;

constexpr std::size_t kQueries = 20000;

struct Query {
  MovingFeatures features;
  exact::TouchTime truth;
};

// near: points move by a tenth of the features' size, near the place where they touch.
std::vector<Query> draw(continuous::FeatureKind kind, const std::string& which) {
  std::vector<Query> out;
  datasets::RandomStream random(core::splitmix64(static_cast<std::uint64_t>(kind) + which.size()));
  const auto somewhere = [&] {
    return core::Vec3d{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
  };
  while (out.size() < kQueries) {
    Query query;
    query.features.kind = kind;
    for (int k = 0; k < 4; ++k) {
      query.features.start[k] = somewhere();
      query.features.end[k] = which == "anywhere" ? somewhere() : query.features.start[k] + 0.1 * somewhere();
    }
    query.truth = exact::first_touch(query.features);
    if (which != "touching" || query.truth.touches) out.push_back(query);
  }
  return out;
}

// A sample of the candidates of a moving surface, evenly spaced in their list.
std::vector<Query> sample(continuous::FeatureKind kind, const std::string& motion) {
  const auto surface = datasets::make_motion(motion + ":20000").value();
  const auto features = continuous::features_of(surface);
  auto engine = reference::octree_cpu_row().create(
      core::Settings::parse("octree-cpu", reference::octree_cpu_row().settings, {}).value());
  const auto boxes = continuous::swept_boxes(surface);
  core::BroadPhase& broad = *engine.value().broad_phase;
  std::vector<Query> out;
  if (!broad.load(boxes, std::vector<std::uint8_t>(boxes.size())) || !broad.find()) return out;
  const auto pairs = reference::find_candidates({surface, features}, broad.read_back().value().pairs);
  const auto& of_kind = kind == continuous::FeatureKind::kVertexFace ? pairs.vertex_face : pairs.edge_edge;
  for (std::size_t k = 0; k < kQueries; ++k) {
    Query query;
    query.features = continuous::moving_features(surface, features, kind, of_kind[k * of_kind.size() / kQueries]);
    query.truth = exact::first_touch(query.features);
    out.push_back(query);
  }
  return out;
}

const std::vector<Query>& queries(continuous::FeatureKind kind, const std::string& which) {
  static std::map<std::pair<continuous::FeatureKind, std::string>, std::vector<Query>> known;
  auto& drawn = known[{kind, which}];
  if (drawn.empty()) drawn = which.find('-') == std::string::npos ? draw(kind, which) : sample(kind, which);
  return drawn;
}

void ask(benchmark::State& state, const core::MotionEngineRow& row, const std::map<std::string, std::string>& given,
         continuous::FeatureKind kind, const std::string& which) {
  auto settings = core::Settings::parse(row.id, row.settings, given);
  auto engine = settings.ok() ? row.create(settings.value()) : core::Result<core::MotionEngine>(settings.error());
  if (!engine) {
    state.SkipWithError(engine.error().line().c_str());
    return;
  }
  const std::vector<Query>& all = queries(kind, which);
  std::uint64_t missed = 0;
  std::uint64_t late = 0;
  for (const Query& query : all) {
    const auto found = engine.value().features->first_touch(query.features);
    missed += query.truth.touches && !(found.ok() && found.value().touches) ? 1 : 0;
    late +=
        query.truth.touches && found.ok() && found.value().touches && found.value().time > query.truth.upper ? 1 : 0;
  }
  if (row.is_certified && missed + late > 0) {
    state.SkipWithError("it missed a touch or was late");
    return;
  }
  std::vector<MovingFeatures> asked;
  for (const Query& query : all) asked.push_back(query.features);
  std::vector<core::FirstTouch> found(asked.size());
  for (auto _ : state)
    if (!engine.value().features->first_touches(asked, found)) state.SkipWithError("it failed");
  benchmark::DoNotOptimize(found.data());
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * all.size()));
  state.counters["touching"] = static_cast<double>(
      std::count_if(all.begin(), all.end(), [](const Query& query) { return query.truth.touches; }));
  state.counters["missed"] = static_cast<double>(missed);
  state.counters["late"] = static_cast<double>(late);
}

}  // namespace

void register_feature_queries() {
  const std::pair<std::string, std::map<std::string, std::string>> subjects[] = {
      {"feature-impact", {{"lanes", "1"}, {"threads", "1"}}},
      {"feature-impact", {{"lanes", "4"}, {"threads", "1"}}},
      {"feature-impact", {{"threads", "1"}}},
      {"feature-impact", {}},
      {"fcl-features", {}},
      {"fcl-features", {{"root", "cubic"}}},
      {"exact-motion", {}},
  };
  for (const auto kind : {continuous::FeatureKind::kVertexFace, continuous::FeatureKind::kEdgeEdge})
    for (const std::string which : {"anywhere", "near", "touching", "folding-sheet", "moving-heap"})
      for (const auto& [id, given] : subjects)
        for (const core::MotionEngineRow& row : reference::motion_engine_rows()) {
          if (row.id != id) continue;
          std::string name = std::string("first-touch/") +
                             (kind == continuous::FeatureKind::kVertexFace ? "vertex-face/" : "edge-edge/") + which +
                             "/" + id;
          char before = '[';
          for (const auto& [key, value] : given) {
            name += before + key + "=" + value;
            before = ',';
          }
          if (!given.empty()) name += "]";
          benchmark::RegisterBenchmark(name.c_str(), [row, given = given, kind, which](benchmark::State& state) {
            ask(state, row, given, kind, which);
          })->UseRealTime();
        }
}

}  // namespace broadside::bench
