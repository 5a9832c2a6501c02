#include "core/mesh/gltf_nodes.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

using Json = nlohmann::json;

std::string node_text(std::size_t number) {
  return "node " + std::to_string(number);
}

class NodeTree {
 public:
  std::string read(const Json& nodes) {
    children_.resize(nodes.size());
    has_parent_.resize(nodes.size(), false);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!nodes[k].is_object()) return node_text(k) + " is no object";
      if (!nodes[k].contains("children")) continue;
      if (!nodes[k]["children"].is_array()) return node_text(k) + " has children that are no list";
      for (const Json& child : nodes[k]["children"]) {
        if (!is_node(child)) return node_text(k) + " has a child that does not exist";
        const auto number = child.get<std::size_t>();
        if (has_parent_[number]) return node_text(number) + " has two parents, but nodes must form a tree";
        has_parent_[number] = true;
        children_[k].push_back(number);
      }
    }
    return {};
  }

  // Each node has at most one parent, so a node that cannot be reached from a root is within itself.
  [[nodiscard]] std::string check_depth(std::size_t deepest) const {
    std::vector<std::size_t> level;
    for (std::size_t k = 0; k < children_.size(); ++k)
      if (!has_parent_[k]) level.push_back(k);
    std::size_t reached = 0;
    for (std::size_t depth = 1; !level.empty(); ++depth) {
      if (depth > deepest)
        return "its nodes nest more than " + std::to_string(deepest) + " levels deep, the most that are read";
      reached += level.size();
      std::vector<std::size_t> next;
      for (const std::size_t k : level) next.insert(next.end(), children_[k].begin(), children_[k].end());
      level = std::move(next);
    }
    return reached == children_.size() ? "" : "a node is its own ancestor, but nodes must form a tree";
  }

  [[nodiscard]] std::string check_scene(const Json& scene) const {
    if (!scene.is_object()) return "a scene is no object";
    if (!scene.contains("nodes")) return {};
    if (!scene["nodes"].is_array()) return "a scene's nodes are no list";
    std::vector<bool> is_listed(children_.size(), false);
    for (const Json& entry : scene["nodes"]) {
      if (!is_node(entry)) return "a scene lists a node that does not exist";
      const auto number = entry.get<std::size_t>();
      if (has_parent_[number] || is_listed[number])
        return "a scene lists " + node_text(number) + ", which has a parent or is listed twice";
      is_listed[number] = true;
    }
    return {};
  }

 private:
  [[nodiscard]] bool is_node(const Json& number) const {
    return number.is_number_unsigned() && number.get<std::uint64_t>() < children_.size();
  }

  std::vector<std::vector<std::size_t>> children_;
  std::vector<bool> has_parent_;
};

}  // namespace

std::string wrong_with_nodes(const Json& document, std::size_t deepest) {
  for (const char* name : {"nodes", "scenes"})
    if (document.contains(name) && !document[name].is_array()) return std::string("its ") + name + " are no list";
  NodeTree tree;
  if (std::string wrong = tree.read(document.value("nodes", Json::array())); !wrong.empty()) return wrong;
  if (std::string wrong = tree.check_depth(deepest); !wrong.empty()) return wrong;
  for (const Json& scene : document.value("scenes", Json::array()))
    if (std::string wrong = tree.check_scene(scene); !wrong.empty()) return wrong;
  return {};
}

}  // namespace broadside::core
