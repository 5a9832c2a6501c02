#include "gpu/engines.hpp"

#include <array>

#include "gpu/engines_on_cuda.hpp"

namespace broadside::gpu {
namespace {

// The keys and values of octree-cpu, but for its threads; and what its broad phase has on devices.
const std::array<core::SettingRow, 11>& octree_settings() {
  static const std::array<core::SettingRow, 11> kTable{{
      {"broad",
       "tree",
       {"tree", "kept", "octree", "brute"},
       "where candidates come from: tree = the fast octree; kept = the same, and of boxes alone keeping what still "
       "holds between frames; octree = P-Alg 1; brute = the levels' published start"},
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
      {"pairs_at_once", "0", {}, "boxes alone: room on the device for so many pairs, found in chunks; 0 = for all"},
      {"parts", "0", {}, "boxes alone: ranges of space, searched each on a device; 0 = one for each device"},
      {"devices", "1", {}, "boxes alone: GPUs that share them; 0 = all that there are"},
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
