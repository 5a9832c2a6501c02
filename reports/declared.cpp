#include "reports/declared.hpp"

#include <algorithm>

#include "core/engine/declaration.hpp"

namespace broadside::reports {

DeclaredTable declared_table(const SceneView& scene) {
  DeclaredTable table;
  for (const core::DeclarationKey& row : core::declaration_keys()) {
    table.keys.emplace_back(row.key);
    table.defaults.emplace_back(row.default_value);
    table.meanings.emplace_back(row.what);
  }
  for (const TraceView& trace : scene.traces)
    for (const auto& [key, value] : trace.declaration)
      if (std::find(table.keys.begin(), table.keys.end(), key) == table.keys.end()) {
        table.keys.push_back(key);
        table.defaults.emplace_back();
        table.meanings.emplace_back();
      }
  for (const TraceView& trace : scene.traces) {
    if (!trace.is_simulation) continue;
    std::vector<std::string> values;
    for (const std::string& key : table.keys) {
      const auto found = trace.declaration.find(key);
      values.push_back(found == trace.declaration.end() ? "" : found->second);
    }
    auto same = std::find_if(table.columns.begin(), table.columns.end(),
                             [&](const DeclaredColumn& column) { return column.values == values; });
    if (same == table.columns.end()) same = table.columns.insert(same, {{}, std::move(values)});
    same->labels.push_back(trace.label);
  }
  return table;
}

std::string undeclared_text(const std::string& default_value) {
  return default_value.empty() ? "not declared" : "not declared: taken as " + default_value;
}

}  // namespace broadside::reports
