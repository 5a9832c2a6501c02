// Decides what assimp may read of a glTF file: the checked triangles and their positions, and nothing else. assimp's
// readers recurse into the JSON and into the nodes, copy a subtree for each parent that names it, open any file that a
// URI names, and take sparse accessors' indices unchecked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace broadside::core {

// glTF needs about 8 levels; assimp's parser uses stack space for each.
inline constexpr std::size_t kDeepestGltfJson = 64;
// Deepest nesting of nodes below a scene: assimp uses stack space for each level.
inline constexpr std::size_t kDeepestGltfNode = 1000;
// Corners and indices, counted once for each node that shows them, because assimp copies them for each node.
inline constexpr std::uint64_t kMostGltfElements = 100'000'000;

// The content that assimp reads in place of the file. It is written from the values that were checked, so that two
// parsers cannot read it in two ways. Kept: nodes with their transforms, meshes' positions, indices and modes,
// accessors, views and buffers. Left out: materials, images, skins, animations, morph targets and extensions, which
// triangles do not need.
//
// Errors, each one line: a .glb whose lengths do not fit the file, a file that is not JSON or nests it too deeply, a
// file that is not glTF 2, nodes that are not a strict tree (a node with two parents or within itself, a scene's node
// that has a parent), nodes that are too deep, positions or indices that are sparse, compressed or outside their
// buffer, a buffer whose URI names no regular file, more elements than kMostGltfElements.
Result<std::string> checked_gltf(const std::filesystem::path& path, bool is_binary);

}  // namespace broadside::core
