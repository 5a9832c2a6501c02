// Obtains a mesh of the catalogue on this machine, with its published sum checked.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/mesh/load_mesh.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

struct MeshOptions {
  std::filesystem::path mesh_dir;   // the user's folder of mesh files; empty = none
  std::filesystem::path cache_dir;  // where fetch_mesh stores its products; empty = none
  // Whether a procedural body of the same size class may replace a missing file; it is marked as a stand-in.
  bool allow_procedural = false;

  // mesh_dir from BROADSIDE_MESH_DIR; cache_dir from XDG_CACHE_HOME or HOME: $XDG_CACHE_HOME/broadside or
  // ~/.cache/broadside.
  static MeshOptions from_environment();
};

// Reads a mesh file of the user's own; Mesh::source is its name and sum. Errors: those of load_mesh.
core::Result<core::LoadedMesh> mesh_from_file(const std::filesystem::path& path);

// A name with an extension is the path of a mesh file. Otherwise the row's files are searched in mesh_dir, then in
// cache_dir, best first. Coordinates are the file's; Mesh::name is the catalogue's, and Mesh::source says which file
// with which sum was used. Errors: unknown name; a file whose sum differs from the published one (a damaged file is
// never skipped without an error); no file, with what to do; and all errors of load_mesh.
core::Result<core::LoadedMesh> acquire_loaded_mesh(std::string_view name, const MeshOptions& options);

// Returns the mesh alone.
core::Result<core::Mesh> acquire_mesh(std::string_view name, const MeshOptions& options);

}  // namespace broadside::datasets
