// Are the nodes of a glTF document a strict tree, as the format demands (glTF 2.0, 3.5.2)? Private to check_gltf.cpp;
// the only header here that names the JSON library.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace broadside::core {

// Empty when each node has at most one parent, no node is within itself or deeper than `deepest` (a root is at depth
// 1), and each scene lists only roots, each once. Otherwise what is wrong, in one line. Uses no recursion.
std::string wrong_with_nodes(const nlohmann::json& document, std::size_t deepest);

}  // namespace broadside::core
