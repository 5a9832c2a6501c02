#include "gpu/engines.hpp"

#include <array>

#include "gpu/engines_on_cuda.hpp"

namespace broadside::gpu {
namespace {

// The keys and values of octree-cpu, but for its threads.
const std::array<core::SettingRow, 8>& octree_settings() {
  static const std::array<core::SettingRow, 8> kTable{{
      {"broad",
       "tree",
       {"tree", "octree", "brute"},
       "where candidates come from: tree = the fast octree; octree = P-Alg 1; brute = the levels' published start"},
      {"levels", "C", {"flat", "level1", "A", "B", "C"}, "body-octree levels tested, as in P-Tables 5 and 6"},
      {"solver", "colored", {"colored", "jacobi", "printed-E8"}, "order in which contacts are resolved"},
      {"variant",
       "sound",
       {"sound", "printed-E1", "printed-E2", "printed-E3", "printed-E4", "printed-E5", "printed-E6", "printed-E7",
        "printed-E8"},
       "a printed, wrong form of the paper to run instead"},
      {"vertex_stage", "on", {"on", "off"}, "off: overlapping boxes of the last level are the verdict"},
      {"contact",
       "conjugate",
       {"conjugate", "soft-step"},
       "bodies that turn: how contacts of a step are solved together; soft-step = one sweep a substep"},
      {"substeps", "0", {}, "bodies that turn: substeps of a step; 0 = what the solver takes"},
      {"thresholds",
       "scaled",
       {"scaled", "fixed"},
       "bodies that turn: slop and bounce speed by size, gravity and step, or fixed = the scene's delta_m and "
       "v_threshold_m_s"},
  }};
  return kTable;
}

// Those of hash-cpu, but for its threads.
const std::array<core::SettingRow, 3>& hash_settings() {
  static const std::array<core::SettingRow, 3> kTable{{
      {"cell_mm", "0", {}, "edge of a cell in mm; 0 = the scene's hash_cell_m, and 250 for boxes alone"},
      {"levels", "C", {"flat", "level1", "A", "B", "C"}, "body-octree levels tested, as in P-Tables 5 and 6"},
      {"vertex_stage", "on", {"on", "off"}, "off: overlapping boxes of the last level are the verdict"},
  }};
  return kTable;
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
