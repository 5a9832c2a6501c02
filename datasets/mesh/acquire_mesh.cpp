#include "datasets/mesh/acquire_mesh.hpp"

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "core/mesh/load_mesh.hpp"
#include "datasets/mesh/mesh_catalogue.hpp"
#include "datasets/mesh/sha256.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Mesh;
using core::Result;
namespace fs = std::filesystem;

// Procedural bodies are one fixed shape per name, whatever the scene's seed.
constexpr std::uint64_t kShapeSeed = 1;

std::string from_environment_variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

Result<Mesh> procedural(const MeshRow& row) {
  Result<Mesh> mesh = row.name == "cube"     ? box_mesh({1.0, 1.0, 1.0}, {8, 8, 8})
                      : row.name == "sphere" ? sphere_mesh(0.5, 8)
                                             : lumpy_mesh(row.triangles, kShapeSeed);
  if (mesh) {
    mesh.value().name = std::string(row.name);
    mesh.value().is_stand_in = !row.is_procedural;
  }
  return mesh;
}

// The sum that this file must have: the published one, or the one written beside it when it was made.
std::string expected_sum(const MeshFile& file, const fs::path& path) {
  if (!file.sha256.empty()) return std::string(file.sha256);
  std::ifstream beside(path.string() + ".sha256");
  std::string sum;
  beside >> sum;
  return sum;
}

Result<Mesh> from_file(const MeshRow& row, const MeshFile& file, const fs::path& path) {
  const Result<std::string> sum = sha256_of_file(path);
  if (!sum) return sum.error();
  const std::string expected = expected_sum(file, path);
  if (sum.value() != expected)
    return Error{"its SHA-256 is " + sum.value() + ", not the expected " + (expected.empty() ? "(none)" : expected),
                 path.string(), "the file is damaged or another one: replace it, or delete it to use the next source"};
  Result<core::LoadedMesh> loaded = core::load_mesh(path);
  if (!loaded) return loaded.error();
  Mesh mesh = std::move(loaded).value().mesh;
  mesh.name = std::string(row.name);
  mesh.source = std::string(file.file) + " sha256 " + sum.value();
  mesh.is_stand_in = file.is_stand_in;
  return mesh;
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

Result<Mesh> acquire_mesh(std::string_view name, const MeshOptions& options) {
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

}  // namespace broadside::datasets
