// Reads a triangle mesh from a file: OBJ, PLY, STL, OFF, glTF, glb.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/math/quat.hpp"
#include "core/mesh/clean_mesh.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// Larger files are refused before they are read. The method's largest model (721,902 triangles) is 14 MB as binary PLY
// and about 60 MB as text; 2 GiB holds fifty million triangles in text and still fits the memory of a small machine.
inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t{2} << 30;

struct LoadedMesh {
  Mesh mesh;        // coordinates as in the file (nodes' transforms applied), name = the file's stem, source = its name
  Dropped dropped;  // after points that coincide were joined, which formats like OBJ and STL repeat by nature
};

// Normals, texture coordinates and colors are dropped first, so that corners which differ only in them share a vertex;
// polygons are cut into triangles, points and lines are left out, every node's transform is applied, and the result is
// cleaned. A binary PLY of shared vertices keeps its bits and its order.
// Errors, each one line: missing, not a file, unreadable, too large, unknown format, broken, no vertices, no triangles,
// a vertex that is NaN or infinite, no triangle with area, polygons of too many corners; and those of check_gltf.hpp.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

// A node of a file that has triangles: a mesh, and where it is in the world.
struct LoadedNode {
  std::string name;
  std::uint32_t mesh = 0;  // index into LoadedNodes::meshes
  Vec3 position;
  Quat orientation;
};

struct LoadedNodes {
  std::vector<Mesh> meshes;  // nodes that show the same triangles at the same scale share one
  std::vector<LoadedNode> nodes;
};

// The file's nodes one by one, as load_mesh reads their triangles. A node's world transform is taken apart into a
// position, a rotation, and what is left (scale, shear, mirroring), which goes into the mesh's vertices, rounded to 20
// bits: the product of float matrices is no more exact, and instances that differ only in place stay one mesh.
// Errors: those of load_mesh.
Result<LoadedNodes> load_nodes(const std::filesystem::path& path);

}  // namespace broadside::core
