#include "bench/campaign/varied_values.hpp"

namespace broadside::bench::campaign {

Values read_values(const datasets::Node* vary, datasets::FileErrors& errors) {
  Values values;
  if (vary == nullptr) return values;
  for (const auto& [key, node] : vary->members) {
    std::vector<std::string>& list = values[key];
    for (const datasets::Node& item : node.items) {
      if (item.kind == datasets::Node::Kind::kText) list.push_back(item.text);
      if (item.kind == datasets::Node::Kind::kWhole) list.push_back(std::to_string(item.whole));
    }
    if (node.kind != datasets::Node::Kind::kArray || list.empty() || list.size() != node.items.size())
      errors.add(node.line, "[vary] " + key + " is not a list of texts or whole numbers",
                 "give for example n = [50, 100]");
  }
  return values;
}

}  // namespace broadside::bench::campaign
