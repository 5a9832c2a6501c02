#include "bench/benchmarks/feature_queries.hpp"

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/exact/feature_touch.hpp"
#include "core/pair.hpp"
#include "datasets/random.hpp"
#include "reference/motion/motion_engines.hpp"

namespace broadside::bench {
namespace {

using continuous::MovingFeatures;

constexpr std::size_t kQueries = 20000;

struct Query {
  MovingFeatures features;
  exact::TouchTime truth;
};

// near: points move by a tenth of the features' size, about where they touch.
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

const std::vector<Query>& queries(continuous::FeatureKind kind, const std::string& which) {
  static std::map<std::pair<continuous::FeatureKind, std::string>, std::vector<Query>> known;
  auto& drawn = known[{kind, which}];
  if (drawn.empty()) drawn = draw(kind, which);
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
  double sum = 0.0;
  for (auto _ : state)
    for (const Query& query : all) sum += engine.value().features->first_touch(query.features).value().time;
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * all.size()));
  state.counters["missed"] = static_cast<double>(missed);
  state.counters["late"] = static_cast<double>(late);
}

}  // namespace

void register_feature_queries() {
  const std::pair<std::string, std::map<std::string, std::string>> subjects[] = {
      {"feature-impact", {}},
      {"fcl-features", {}},
      {"fcl-features", {{"root", "cubic"}}},
      {"exact-motion", {}},
  };
  for (const auto kind : {continuous::FeatureKind::kVertexFace, continuous::FeatureKind::kEdgeEdge})
    for (const std::string which : {"anywhere", "near", "touching"})
      for (const auto& [id, given] : subjects)
        for (const core::MotionEngineRow& row : reference::motion_engine_rows())
          if (row.id == id) {
            const std::string name = std::string("first-touch/") +
                                     (kind == continuous::FeatureKind::kVertexFace ? "vertex-face/" : "edge-edge/") +
                                     which + "/" + id + (given.empty() ? "" : "[root=cubic]");
            benchmark::RegisterBenchmark(name.c_str(), [row, given = given, kind, which](benchmark::State& state) {
              ask(state, row, given, kind, which);
            });
          }
}

}  // namespace broadside::bench
