// The one table of meshes that a scene's name may contain.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

// A model inside a package, from which a file of the catalogue is made.
struct MeshSource {
  bool is_npm = false;  // otherwise an apt package
  std::string_view package;
  std::string_view version;  // for which the sums were taken; the sum decides, not the version
  std::string_view member;   // in the package's file tree
  std::string_view inner;    // path in the archive that the member is; empty = the member is the model
  std::string_view model_file;
  std::string_view sha256;  // of the model file
};

// A file that counts as this mesh. `sha256` is empty where the file is rebuilt on each machine and has no published
// sum; its own sum is then stored beside it when it is made.
struct MeshFile {
  std::string_view file;
  std::string_view sha256;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::uint32_t boundary_edges = 0;  // 0: closed; every file here is a manifold
  std::int32_t euler_characteristic = 2;
  double covering_radius = 0.0;  // rho of METHOD section 3, in the file's unit
  bool is_stand_in = false;      // has detail that the original does not have: reports say so
  std::string_view what;
  const MeshSource* source = nullptr;  // from which `fetch_mesh` makes it; null = it cannot be made here
};

struct MeshRow {
  std::string_view name;
  std::string_view what;
  std::span<const MeshFile> files;  // best first; the first file that exists is used
  std::uint32_t vertices = 0;       // the size class: the vertex count of the paper's model where it has one
  std::uint32_t triangles = 0;
  std::string_view credit;
  // How `fetch_mesh` obtains it; empty = it cannot be fetched.
  std::string_view fetched_from;
  // Made here from a formula, without a file.
  bool is_procedural = false;
};

std::span<const MeshRow> mesh_catalogue();
std::vector<std::string_view> mesh_names();

// Error: there is no such mesh; the error names the nearest known one.
core::Result<const MeshRow*> find_mesh(std::string_view name);

}  // namespace broadside::datasets
