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
  Dropped dropped;  // counted after coincident points were joined, which formats like OBJ and STL always repeat
};

// Normals, texture coordinates and colors are dropped first, so that corners that differ only in them share a vertex.
// Polygons are cut into triangles, points and lines are left out, every node's transform is applied, and the result is
// cleaned. A binary PLY with shared vertices keeps its bits and its order.
// Errors, each one line: a file that is missing, not a file, unreadable, too large, of an unknown format or broken; no
// vertices, no triangles, a vertex that is NaN or infinite, no triangle with area, polygons with too many corners; and
// those of check_gltf.hpp.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

// A node of a file that has triangles: a mesh, and its place in the world.
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

// Gives the file's nodes one by one; triangles are read as by load_mesh. A node's world transform is decomposed into a
// position, a rotation, and a rest (scale, shear, mirroring). The rest is applied to the mesh's vertices, rounded to 20
// bits: the product of float matrices is no more exact, and instances that differ only in their placement stay one
// mesh.
// Errors: those of load_mesh.
Result<LoadedNodes> load_nodes(const std::filesystem::path& path);

}  // namespace broadside::core
