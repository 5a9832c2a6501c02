#include "bench/engines.hpp"

#include <vector>

#include "bench/fetched/fetched_engines.hpp"
#include "bench/plugin_engines.hpp"
#include "core/nearest_name.hpp"
#include "gpu/engines.hpp"
#include "reference/engines.hpp"

namespace broadside::bench {

std::span<const core::EngineRow> engines() {
  static const std::vector<core::EngineRow> kTable = [] {
    std::vector<core::EngineRow> rows{gpu::octree_gpu_row(), gpu::hash_gpu_row()};
    for (const reference::EngineRowFunction row : reference::engine_rows()) rows.push_back(row());
    for (const core::EngineRow& row : fetched_engine_rows()) rows.push_back(row);
    return rows;
  }();
  return kTable;
}

core::Result<const core::EngineRow*> find_engine(std::string_view id) {
  if (is_plugin_path(id)) return plugin_row(id);
  if (const std::string command = fetched_command(id); !command.empty()) return plugin_row(command, fetched_folder(id));
  std::vector<std::string_view> ids;
  for (const core::EngineRow& row : engines()) {
    if (row.id == id) return &row;
    ids.push_back(row.id);
  }
  return core::Error{"unknown engine '" + std::string(id) + "'", "--engine",
                     core::advise_name(id, ids, "broadside list engines")};
}

std::string why_absent(const core::EngineRow& row) {
  return row.absent != nullptr ? row.absent() : std::string();
}

}  // namespace broadside::bench
