// The engine `hash-cpu`: the spatial hash, and the pipeline's later stages behind it.
#include <oneapi/tbb/version.h>

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/method/method_settings.hpp"
#include "core/parameters.hpp"
#include "reference/engines.hpp"
#include "reference/octree_cpu/pipeline.hpp"
#include "reference/spatial_hash/hash_broad_phase.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "hash-cpu";

std::span<const core::SettingRow> setting_rows() {
  static const std::vector<core::SettingRow> kSettings{core::cell_setting(), core::levels_setting(), threads_setting(),
                                                       core::vertex_stage_setting()};
  return kSettings;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  const float given_m = static_cast<float>(settings.number("cell_mm")) / 1000.0F;
  const int workers = worker_count(settings.number("threads"));
  PipelineOptions options;
  // In the pipeline's own arena.
  options.make_broad_phase = [given_m](const core::Scene& scene) {
    return make_hash_broad_phase(given_m > 0.0F ? given_m : scene.parameters.hash_cell_m);
  };
  options.levels = *core::levels_named(settings.text("levels"));
  options.has_vertex_stage = settings.text("vertex_stage") == "on";
  options.threads = workers;

  core::Engine engine;
  engine.id = kId;
  engine.build =
      "Broadside, float32, oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
  engine.settings = settings;
  engine.broad_phase = make_hash_broad_phase(given_m > 0.0F ? given_m : core::Parameters{}.hash_cell_m, workers);
  engine.declaration = core::method_declaration();
  engine.dynamics = std::make_unique<Pipeline>(std::move(options));
  return engine;
}

}  // namespace

core::EngineRow hash_cpu_row() {
  return {.id = kId,
          .capabilities = "broad dynamics",
          .what = "the paper's comparison: a spatial hash as broad phase, then the pipeline's own later stages",
          .settings = setting_rows(),
          .runs_in_child = false,
          .create = create,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
