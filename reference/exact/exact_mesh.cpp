// The arbiter of narrow phases: least distance of triangle surfaces, or of vertices, in double.
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/exact/triangle_tree.hpp"
#include "reference/engines.hpp"
#include "reference/exact/exact_point.hpp"
#include "reference/pair_check.hpp"
#include "reference/turned_shapes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using exact::Nearest;
using exact::Point;
using exact::TriangleTree;

constexpr std::string_view kExactMeshId = "exact-mesh";

using Search = Nearest (*)(const TriangleTree&, core::Vec3, const TriangleTree&, core::Vec3);

Separation separation_of(const Nearest& near) {
  Separation out;
  out.distance_m = std::sqrt(near.squared_m2);
  out.is_touching = near.squared_m2 == 0.0;
  out.witness_a = to_core(near.on_a);
  out.witness_b = to_core(near.on_b);
  if (out.distance_m > 0.0) out.normal = to_core((1.0 / out.distance_m) * (near.on_a - near.on_b));
  return out;
}

class ExactMesh final : public core::NarrowPhase {
 public:
  ExactMesh(Search search, int workers) : search_(search), arena_(workers) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("exact-mesh: load", [&]() -> Status {
      trees_.load(scene);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kExactMeshId, pairs, poses, trees_.body_count()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("exact-mesh: measure", [&]() -> Status {
      const std::vector<const TriangleTree*> trees = trees_.of(pairs, poses);
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          const auto [i, j] = pairs[k];
          separations_[k] = separation_of(search_(*trees[i], poses[i].position, *trees[j], poses[j].position));
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  Search search_;
  tbb::task_arena arena_;
  TurnedShapes<TriangleTree> trees_{
      [](const core::Mesh& mesh, core::Quat q) { return std::make_unique<TriangleTree>(mesh, q); }};
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> exact_mesh_settings() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"method",
       "surface-tree",
       {"surface-tree", "surface-brute", "vertices-brute"},
       "least distance of surfaces by a box tree or over all triangle pairs; or of vertices (d_vv) over all pairs"},
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> create_exact_mesh(const core::Settings& settings) {
  const std::string& method = settings.text("method");
  core::Engine engine;
  engine.id = kExactMeshId;
  engine.build = "own, double, oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
  engine.settings = settings;
  const int workers = worker_count(settings.number("threads"));
  engine.equivalence = [build = engine.build, workers, method](const core::Scene&) {
    core::EquivalenceCard card =
        own_card(build, "float64, touching by exact predicates", "as the compiler made it", workers);
    card.push_back({"shape", "triangle surfaces, vertices turned and moved in float32 as the pipeline does", ""});
    card.push_back({"method", method, method == "vertices-brute" ? "distance of surfaces" : ""});
    card.push_back({"shape margin", "none", ""});
    card.push_back({"tolerance", "none: rounding of double", ""});
    return card;
  };
  engine.narrow_phase = std::make_unique<ExactMesh>(method == "surface-tree"    ? exact::nearest_of_trees
                                                    : method == "surface-brute" ? exact::nearest_by_brute_force
                                                                                : exact::nearest_vertices,
                                                    workers);
  return engine;
}

}  // namespace

core::EngineRow exact_mesh_row() {
  return {.id = kExactMeshId,
          .capabilities = "narrow",
          .what = "least distance of triangle surfaces or of vertices in double: the arbiter of narrow phases",
          .settings = exact_mesh_settings(),
          .runs_in_child = true,
          .create = create_exact_mesh,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
