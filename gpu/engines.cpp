#include "gpu/engines.hpp"

#include <array>

#include "gpu/octree_gpu.hpp"

namespace broadside::gpu {
namespace {

// The keys and values of octree-cpu, but for its threads.
const std::array<core::SettingRow, 5>& settings_table() {
  static const std::array<core::SettingRow, 5> kTable{{
      {"broad", "tree", {"tree", "brute"}, "where candidates come from; brute = the levels' published start"},
      {"levels", "C", {"flat", "level1", "A", "B", "C"}, "body-octree levels tested, as in P-Tables 5 and 6"},
      {"solver", "colored", {"colored", "jacobi", "printed-E8"}, "order in which contacts are resolved"},
      {"variant",
       "sound",
       {"sound", "printed-E2", "printed-E3", "printed-E4", "printed-E5", "printed-E6", "printed-E7", "printed-E8"},
       "a printed, wrong form of the paper to run instead"},
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
  row.settings = settings_table();
  row.is_reference = false;
  row.create = create_octree_gpu;
  row.absent = octree_gpu_absent;
  return row;
}

}  // namespace broadside::gpu
