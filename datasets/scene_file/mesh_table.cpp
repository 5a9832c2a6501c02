#include "datasets/scene_file/mesh_table.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/clean_mesh.hpp"
#include "core/nearest_name.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/cylinder_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::datasets {
namespace {

using core::Mesh;
using core::Result;

constexpr std::array<std::string_view, 5> kShapes{"box", "sphere", "capsule", "cylinder", "lumpy"};

// A mesh's error says what is wrong with it; this puts the scene file's line in front.
std::optional<Mesh> taken(TableReader& table, std::string_view key, Result<Mesh> mesh) {
  if (mesh) return std::move(mesh).value();
  const core::Error& e = mesh.error();
  table.fail(key, e.where.empty() ? e.what : e.where + ": " + e.what, e.advice);
  return std::nullopt;
}

Result<Mesh> from_file(const std::filesystem::path& path) {
  Result<core::LoadedMesh> loaded = mesh_from_file(path);
  if (!loaded) return loaded.error();
  return std::move(loaded).value().mesh;
}

std::optional<Mesh> from_shape(TableReader& table, const std::string& shape) {
  if (shape == "box") {
    std::vector<double> sides{1.0, 1.0, 1.0};
    std::vector<double> segments{8.0, 8.0, 8.0};
    table.numbers("sides_m", 3, sides);
    table.numbers("segments", 3, segments);
    std::array<int, 3> cuts{};
    for (int k = 0; k < 3; ++k) {
      if (!(segments[k] >= 1.0 && segments[k] <= 1024.0) || segments[k] != static_cast<int>(segments[k]))
        return table.fail("segments", "segments are not whole numbers from 1 to 1024", "give for example [8, 8, 8]"),
               std::nullopt;
      cuts[k] = static_cast<int>(segments[k]);
    }
    return taken(table, "sides_m", box_mesh({sides[0], sides[1], sides[2]}, cuts));
  }
  if (shape == "sphere") {
    double radius_m = 0.5;
    std::uint32_t frequency = 8;
    table.positive("radius_m", radius_m);
    table.whole("frequency", 1U, 1024U, frequency);
    return taken(table, "shape", sphere_mesh(radius_m, static_cast<int>(frequency)));
  }
  if (shape == "capsule" || shape == "cylinder") {
    const bool is_capsule = shape == "capsule";
    double radius_m = 0.5;
    double half_length_m = 0.5;
    std::uint32_t cuts = is_capsule ? 8 : 64;
    table.positive("radius_m", radius_m);
    table.positive("half_length_m", half_length_m);
    table.whole(is_capsule ? "frequency" : "sides", 2U, 4096U, cuts);
    const int parts = static_cast<int>(cuts);
    return taken(
        table, "shape",
        is_capsule ? capsule_mesh(radius_m, half_length_m, parts) : cylinder_mesh(radius_m, half_length_m, parts));
  }
  if (shape == "lumpy") {
    std::uint32_t triangles = 4968;
    std::uint32_t seed = 1;
    table.whole("triangles", 20U, 20U * 1024U * 1024U, triangles);
    table.whole("seed", 0U, 0xFFFFFFFFU, seed);
    return taken(table, "shape", lumpy_mesh(triangles, seed));
  }
  table.fail("shape", "no such shape '" + shape + "'", core::advise_name(shape, kShapes));
  return std::nullopt;
}

std::optional<Mesh> scaled(TableReader& table, Mesh mesh) {
  double longest_side_m = 0.0;
  double scale = 0.0;
  const bool has_longest = table.positive("longest_side_m", longest_side_m);
  const bool has_scale = table.positive("scale", scale);
  if (has_longest && has_scale)
    return table.fail("scale", "the mesh has a longest_side_m and a scale", "give one of them"), std::nullopt;
  if (has_longest) return core::normalized(std::move(mesh), longest_side_m);
  if (has_scale)
    for (core::Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(double{v[k]} * scale);
  return mesh;
}

}  // namespace

std::optional<Mesh> read_mesh_table(const Node& node, const std::filesystem::path& folder, const MeshOptions& options,
                                    FileErrors& errors) {
  TableReader table(node, "this mesh", errors);
  std::string name;
  std::string catalogue;
  std::string file;
  std::string shape;
  table.text("name", name);
  const bool has_catalogue = table.text("catalogue", catalogue);
  const bool has_file = table.text("file", file);
  const bool has_shape = table.text("shape", shape);
  if (errors.first) return std::nullopt;
  if (int{has_catalogue} + int{has_file} + int{has_shape} != 1)
    return errors.add(node.line, "the mesh does not say where it comes from",
                      "give exactly one of catalogue = \"bunny\", file = \"body.ply\", shape = \"box\""),
           std::nullopt;

  std::optional<Mesh> mesh = has_catalogue ? taken(table, "catalogue", acquire_mesh(catalogue, options))
                             : has_file    ? taken(table, "file", from_file(folder / file))
                                           : from_shape(table, shape);
  if (!mesh) return std::nullopt;
  mesh = scaled(table, std::move(*mesh));
  if (!mesh) return std::nullopt;
  if (!name.empty()) mesh->name = name;
  table.finish();
  if (errors.first) return std::nullopt;
  return mesh;
}

}  // namespace broadside::datasets
