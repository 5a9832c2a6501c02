#include "gpu/engines.hpp"

#include <span>
#include <vector>

#include "core/method/method_settings.hpp"
#include "gpu/engines_on_cuda.hpp"

namespace broadside::gpu {
namespace {

// The keys and values of octree-cpu, except its threads, and what the broad phase has on devices.
std::span<const core::SettingRow> octree_settings() {
  static const std::vector<core::SettingRow> kSettings{
      {"broad",
       "tree",
       {"tree", "kept", "octree", "brute"},
       "where candidates come from: tree = the fast octree; kept = the same, for boxes alone keeping pairs that "
       "still hold from frame to frame; octree = P-Alg 1; brute = all pairs, the levels' published start"},
      core::levels_setting(),
      core::solver_setting(),
      core::variant_setting(),
      core::vertex_stage_setting(),
      core::contact_setting(),
      core::substeps_setting(),
      core::thresholds_setting(),
      core::sleep_setting(),
      core::sweep_setting(),
      {"pairs_at_once",
       "0",
       {},
       "boxes alone: how many pairs the device has room for; they are found in chunks; 0 = room for all"},
      {"parts",
       "0",
       {},
       "boxes alone: number of ranges of space, each searched on one device; 0 = one for each device"},
      {"devices", "1", {}, "boxes alone: number of GPUs that share them; 0 = all GPUs"},
  };
  return kSettings;
}

// The keys and values of hash-cpu, except its threads.
std::span<const core::SettingRow> hash_settings() {
  static const std::vector<core::SettingRow> kSettings{core::cell_setting(), core::levels_setting(),
                                                       core::vertex_stage_setting()};
  return kSettings;
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
