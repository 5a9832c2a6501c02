// What engines declared of themselves, side by side.
#pragma once

#include <string>
#include <vector>

#include "reports/scene_view.hpp"

namespace broadside::reports {

// Engines of one declaration share a column.
struct DeclaredColumn {
  std::vector<std::string> labels;
  std::vector<std::string> values;  // one a row; empty = not declared
};

struct DeclaredTable {
  std::vector<std::string> keys;      // every key of the table of keys, then keys that this build does not know
  std::vector<std::string> defaults;  // what a key that is not declared is taken as; empty = nothing
  std::vector<std::string> meanings;
  std::vector<DeclaredColumn> columns;
};

// Of the engines that moved bodies: laws are chosen by what those declare. No columns when there is none.
DeclaredTable declared_table(const SceneView& scene);

// "not declared: taken as cone".
std::string undeclared_text(const std::string& default_value);

// As escaped HTML; empty when no engine moved bodies.
std::string declared_html(const SceneView& scene);

}  // namespace broadside::reports
