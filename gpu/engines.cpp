#include "gpu/engines.hpp"

#include <span>
#include <vector>

#include "core/method/method_settings.hpp"
#include "gpu/engines_on_cuda.hpp"

namespace broadside::gpu {
namespace {

// The keys and values of octree-cpu, but for its threads and for what it keeps between frames.
std::span<const core::SettingRow> octree_settings() {
  static const std::vector<core::SettingRow> rows{
      {"broad",
       "tree",
       {"tree", "octree", "brute"},
       "where candidates come from: tree = the fast octree; octree = P-Alg 1; brute = the levels' published start"},
      core::levels_setting(),
      core::solver_setting(),
      core::variant_setting(),
      core::vertex_stage_setting(),
      core::contact_setting(),
      core::substeps_setting(),
      core::thresholds_setting(),
  };
  return rows;
}

// Those of hash-cpu, but for its threads.
std::span<const core::SettingRow> hash_settings() {
  static const std::vector<core::SettingRow> rows{core::cell_setting(), core::levels_setting(),
                                                  core::vertex_stage_setting()};
  return rows;
}

}  // namespace

core::EngineRow octree_gpu_row() {
  core::EngineRow row;
  row.id = "octree-gpu";
  row.capabilities = "broad dynamics";
  row.what = "the pipeline on CUDA, bit-identical to octree-cpu";
  row.settings = octree_settings();
  row.runs_in_child = false;
  row.create = create_octree_gpu;
  row.absent = gpu_absent;
  return row;
}

core::EngineRow hash_gpu_row() {
  core::EngineRow row;
  row.id = "hash-gpu";
  row.capabilities = "broad dynamics";
  row.what = "the paper's comparison on CUDA: a spatial hash as broad phase, bit-identical to hash-cpu";
  row.settings = hash_settings();
  row.runs_in_child = false;
  row.create = create_hash_gpu;
  row.absent = gpu_absent;
  return row;
}

}  // namespace broadside::gpu
