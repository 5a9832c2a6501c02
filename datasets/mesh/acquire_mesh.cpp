#include "datasets/mesh/acquire_mesh.hpp"

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "datasets/mesh/mesh_catalogue.hpp"
#include "datasets/mesh/sha256.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/convex_mesh.hpp"
#include "datasets/shapes/cylinder_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Mesh;
using core::Result;
namespace fs = std::filesystem;

// The shape of a procedural body depends only on its name, not on the scene's seed.
constexpr std::uint64_t kShapeSeed = 1;

std::string from_environment_variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? std::string() : std::string(value);
}

// Boxes are cut so that a mean edge is about an eighth of the longest side.
Result<Mesh> shape_of(const MeshRow& row) {
  if (row.name == "cube") return box_mesh({1.0, 1.0, 1.0}, {8, 8, 8});
  if (row.name == "brick") return box_mesh({1.0, 0.5, 0.5}, {8, 4, 4});
  if (row.name == "domino") return box_mesh({0.2, 1.0, 0.5}, {2, 8, 4});
  if (row.name == "sphere") return sphere_mesh(0.5, 8);
  if (row.name == "capsule") return capsule_mesh(0.25, 0.25, 8);
  if (row.name == "cylinder") return cylinder_mesh(0.25, 0.5, 64);
  if (row.name == "stone") return convex_mesh({1.0, 0.8, 0.6}, 24, kShapeSeed);
  return lumpy_mesh(row.triangles, kShapeSeed);
}

Result<core::LoadedMesh> procedural(const MeshRow& row) {
  Result<Mesh> mesh = shape_of(row);
  if (!mesh) return mesh.error();
  core::LoadedMesh loaded{std::move(mesh).value(), {}};
  loaded.mesh.name = std::string(row.name);
  loaded.mesh.is_stand_in = !row.is_procedural;
  return loaded;
}

// The sum that this file must have: the published one, or the one that was written beside the file when it was made.
std::string expected_sum(const MeshFile& file, const fs::path& path) {
  if (!file.sha256.empty()) return std::string(file.sha256);
  std::ifstream beside(path.string() + ".sha256");
  std::string sum;
  beside >> sum;
  return sum;
}

Result<core::LoadedMesh> from_file(const MeshRow& row, const MeshFile& file, const fs::path& path) {
  const Result<std::string> sum = sha256_of_file(path);
  if (!sum) return sum.error();
  const std::string expected = expected_sum(file, path);
  if (sum.value() != expected)
    return Error{"its SHA-256 is " + sum.value() + ", not the expected " + (expected.empty() ? "(none)" : expected),
                 path.string(), "the file is damaged or another one: replace it, or delete it to use the next source"};
  Result<core::LoadedMesh> loaded = core::load_mesh(path);
  if (!loaded) return loaded.error();
  Mesh& mesh = loaded.value().mesh;
  mesh.name = std::string(row.name);
  mesh.source = std::string(file.file) + " sha256 " + sum.value();
  mesh.is_stand_in = file.is_stand_in;
  return loaded;
}

}  // namespace

MeshOptions MeshOptions::from_environment() {
  MeshOptions options;
  options.mesh_dir = from_environment_variable("BROADSIDE_MESH_DIR");
  const std::string cache = from_environment_variable("XDG_CACHE_HOME");
  const std::string home = from_environment_variable("HOME");
  if (!cache.empty())
    options.cache_dir = fs::path(cache) / "broadside";
  else if (!home.empty())
    options.cache_dir = fs::path(home) / ".cache" / "broadside";
  return options;
}

Result<core::LoadedMesh> mesh_from_file(const fs::path& path) {
  Result<core::LoadedMesh> loaded = core::load_mesh(path);
  if (!loaded) return loaded.error();
  const Result<std::string> sum = sha256_of_file(path);
  if (!sum) return sum.error();
  loaded.value().mesh.source += " sha256 " + sum.value();
  return loaded;
}

Result<core::LoadedMesh> acquire_loaded_mesh(std::string_view name, const MeshOptions& options) {
  if (fs::path(name).has_extension()) return mesh_from_file(name);
  const auto found = find_mesh(name);
  if (!found) return found.error();
  const MeshRow& row = *found.value();
  if (row.is_procedural) return procedural(row);

  for (const fs::path& folder : {options.mesh_dir, options.cache_dir}) {
    if (folder.empty()) continue;
    for (const MeshFile& file : row.files) {
      std::error_code failed;
      const fs::path path = folder / file.file;
      if (fs::exists(path, failed)) return from_file(row, file, path);
    }
  }
  if (options.allow_procedural) return procedural(row);
  const std::string fetch = row.fetched_from.empty() ? "" : "run 'broadside fetch " + std::string(name) + "', or ";
  return Error{"none of its files is on this machine", "mesh '" + std::string(name) + "'",
               fetch + "set BROADSIDE_MESH_DIR to a folder that has " + std::string(row.files[0].file)};
}

Result<Mesh> acquire_mesh(std::string_view name, const MeshOptions& options) {
  Result<core::LoadedMesh> loaded = acquire_loaded_mesh(name, options);
  if (!loaded) return loaded.error();
  return std::move(loaded).value().mesh;
}

}  // namespace broadside::datasets
