// The one table of meshes that scenes may name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

// A file that counts as this mesh. `sha256` is empty where the file is rebuilt on each machine and has no published
// sum; it then has a sum of its own beside it, written when it was made.
struct MeshFile {
  std::string_view file;
  std::string_view sha256;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  bool is_stand_in = false;  // detail that is not the original's: reports say so
  std::string_view what;
};

struct MeshRow {
  std::string_view name;
  std::string_view what;
  std::span<const MeshFile> files;  // best first; the first that is there is taken
  std::uint32_t vertices = 0;       // the size class: of the paper's model where it has one
  std::uint32_t triangles = 0;
  std::string_view credit;
  // How `fetch_mesh` obtains it; empty = it cannot be fetched.
  std::string_view fetched_from;
  // Made here from a formula; needs no file.
  bool is_procedural = false;
};

std::span<const MeshRow> mesh_catalogue();
std::vector<std::string_view> mesh_names();

// Error: no such mesh, with the nearest known name.
core::Result<const MeshRow*> find_mesh(std::string_view name);

}  // namespace broadside::datasets
