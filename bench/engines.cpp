#include "bench/engines.hpp"

#include <vector>

#include "bench/plugin_engines.hpp"
#include "core/nearest_name.hpp"
#include "gpu/engines.hpp"
#include "reference/engines.hpp"
#include "reference/octree_cpu/engine.hpp"

namespace broadside::bench {

// To add an engine: its file, and one line here.
std::span<const core::EngineRow> engines() {
  static const std::vector<core::EngineRow> kTable{
      gpu::octree_gpu_row(),
      gpu::hash_gpu_row(),
      reference::octree_cpu_row(),
      reference::hash_cpu_row(),
      reference::all_pairs_row(),
      reference::bullet_dbvt_row(),
      reference::bullet_dbvt_tree_row(),
      reference::bullet_sap_row(),
      reference::fcl_tree_row(),
      reference::fcl_sap_row(),
      reference::embree_collide_row(),
      reference::cgal_boxes_row(),
      reference::ccd_row(),
      reference::bullet_box_row(),
      reference::fcl_box_row(),
      reference::exact_mesh_row(),
      reference::fcl_mesh_row(),
      reference::exact_shapes_row(),
      reference::fcl_shapes_row(),
      reference::bullet_shapes_row(),
      reference::bullet_world_row(),
  };
  return kTable;
}

core::Result<const core::EngineRow*> find_engine(std::string_view id) {
  if (is_plugin_path(id)) return plugin_row(id);
  std::vector<std::string_view> ids;
  for (const core::EngineRow& row : engines()) {
    if (row.id == id) return &row;
    ids.push_back(row.id);
  }
  return core::Error{"unknown engine '" + std::string(id) + "'", "--engine", core::advise_name(id, ids)};
}

std::string why_absent(const core::EngineRow& row) {
  return row.absent != nullptr ? row.absent() : std::string();
}

}  // namespace broadside::bench
