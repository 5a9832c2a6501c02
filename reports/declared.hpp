// The declarations of engines, side by side.
#pragma once

#include <string>
#include <vector>

#include "reports/scene_view.hpp"

namespace broadside::reports {

// Engines with the same declaration share a column.
struct DeclaredColumn {
  std::vector<std::string> labels;
  std::vector<std::string> values;  // one for each row; empty = not declared
};

struct DeclaredTable {
  std::vector<std::string> keys;      // every key of the table of keys, then keys that this build does not know
  std::vector<std::string> defaults;  // the value that is assumed for a key that is not declared; empty = none
  std::vector<std::string> meanings;
  std::vector<DeclaredColumn> columns;
};

// The declarations of engines that moved bodies, because laws are chosen by these. No columns when there is none.
DeclaredTable declared_table(const SceneView& scene);

// "not declared: taken as cone".
std::string undeclared_text(const std::string& default_value);

// As escaped HTML; empty when no engine moved bodies.
std::string declared_html(const SceneView& scene);

}  // namespace broadside::reports
