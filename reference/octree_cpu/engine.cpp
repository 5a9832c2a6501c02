#include <oneapi/tbb/version.h>

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/method/method_settings.hpp"
#include "core/method/rigid/refuse_method_settings.hpp"
#include "core/method/rigid/rigid_declaration.hpp"
#include "core/method/rigid/rigid_settings.hpp"
#include "core/variant.hpp"
#include "reference/engines.hpp"
#include "reference/octree_cpu/pipeline_by_motion.hpp"
#include "reference/octree_cpu/rigid/rigid_declaration.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

std::span<const core::SettingRow> settings_table() {
  static const std::vector<core::SettingRow> kSettings{
      {"broad",
       "tree",
       {"tree", "kept", "octree", "brute"},
       "where candidates come from: tree = the fast octree; kept = the same, keeping pairs that still hold from "
       "frame to frame; octree = P-Alg 1; brute = all pairs, the levels' published start"},
      core::levels_setting(),
      core::solver_setting(),
      {"threads", "0", {}, "threads; 0 = all. The result is the same to the bit"},
      core::variant_setting(),
      core::vertex_stage_setting(),
      core::contact_setting(),
      core::substeps_setting(),
      core::thresholds_setting(),
      core::sleep_setting(),
      core::sweep_setting(),
  };
  return kSettings;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  PipelineOptions options;
  options.levels = *core::levels_named(settings.text("levels"));
  options.variant = *core::variant_named(settings.text("variant"));
  const unsigned long asked = settings.number("threads");
  const int threads = asked == 0 ? 0 : worker_count(asked);  // oneTBB warns if asked for more than the cores
  std::unique_ptr<core::BroadPhase> alone;
  // E2 and E7 are faults of the published scene octree, so they need broad=octree.
  const bool needs_octree = options.variant == core::Variant::kE2 || options.variant == core::Variant::kE7;
  if (needs_octree || settings.text("broad") == "octree") {
    options.make_broad_phase = [variant = options.variant](const core::Scene& scene) {
      return make_scene_octree_broad_phase(scene.domain, core::kSceneOctreeDepth, variant);
    };
    options.records_octree = true;
    alone = make_scene_octree_broad_phase(core::empty_box(), core::kSceneOctreeDepth, options.variant, threads);
  } else if (settings.text("broad") == "tree") {
    options.make_broad_phase = [](const core::Scene&) { return make_tree_broad_phase(); };
    alone = make_tree_broad_phase(threads);
  } else if (settings.text("broad") == "kept") {
    options.make_broad_phase = [](const core::Scene&) { return make_kept_broad_phase(); };
    alone = make_kept_broad_phase(threads);
  }
  const std::string& solver = settings.text("solver");
  if (solver == "jacobi") options.solver = Solver::kJacobi;
  if (solver == "printed-E8" || options.variant == core::Variant::kE8) options.solver = Solver::kRacing;
  options.has_vertex_stage = settings.text("vertex_stage") == "on";
  options.threads = threads;

  RigidPipelineOptions turning;
  turning.make_broad_phase = options.make_broad_phase;
  turning.levels = options.levels;
  const core::SoftSettings soft = core::soft_settings_of(settings);
  turning.make_solver = [soft, is_fixed = settings.text("thresholds") == "fixed"](const core::Scene& scene) {
    return make_soft_solver(is_fixed ? core::with_fixed_thresholds(soft, scene) : soft);
  };
  turning.sleeps = settings.text("sleep") == "on";
  turning.swept = core::swept_named(settings.text("sweep"));
  turning.declare = [soft, swept = turning.swept](const core::Scene& scene) {
    return core::rigid_declaration(soft, scene, swept);
  };
  turning.threads = threads;

  core::Engine engine;
  engine.id = "octree-cpu";
  engine.build =
      "Broadside, float32, oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
  engine.settings = settings;
  engine.broad_phase = std::move(alone);
  engine.declaration = core::method_declaration();
  engine.dynamics = std::make_unique<PipelineByMotion>(std::move(options), std::move(turning),
                                                       core::refuse_method_settings("octree-cpu", settings));
  engine.equivalence = [soft, swept = core::swept_named(settings.text("sweep")),
                        sleeps = settings.text("sleep") == "on", build = engine.build,
                        workers = worker_count(settings.number("threads"))](const core::Scene& scene) {
    return rigid_card(scene, soft, swept, sleeps, build, workers);
  };
  return engine;
}

}  // namespace

core::EngineRow octree_cpu_row() {
  core::EngineRow row;
  row.id = "octree-cpu";
  row.capabilities = "broad dynamics";
  row.what = "the pipeline's own stages on CPU threads: the twin of octree-gpu";
  row.settings = settings_table();
  row.runs_in_child = false;
  row.create = create;
  return row;
}

}  // namespace broadside::reference
