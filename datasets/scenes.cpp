#include "datasets/scenes.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "core/nearest_name.hpp"
#include "datasets/generators/paper_scenes.hpp"
#include "datasets/generators/small_scenes.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Result;
using core::Scene;

using MeshSceneMaker = Result<Scene> (*)(std::string_view mesh, std::uint32_t count, const SceneOptions& options);

struct MeshSceneRow {
  std::string_view family;
  SceneRow row;
  MeshSceneMaker make;
};

constexpr std::array<MeshSceneRow, 2> kMeshScenes{{
    {"freefall",
     {"freefall:MESH:N", "freefall:bunny:50", "free-fall stacking: N bodies from a jittered grid onto the floor"},
     freefall_scene},
    {"randommove",
     {"randommove:MESH:N", "randommove:dragon:250", "N bodies at random in a closed cube, without gravity"},
     random_move_scene},
}};

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t colon = text.find(':');
    parts.push_back(text.substr(0, colon));
    if (colon == std::string_view::npos) return parts;
    text.remove_prefix(colon + 1);
  }
}

Result<std::uint32_t> body_count(std::string_view text, const std::string& spec) {
  std::uint32_t count = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (failed != std::errc() || end != text.data() + text.size() || count > kMaxBodies)
    return Error{"the number of bodies is '" + std::string(text) + "'", "scene '" + spec + "'",
                 "give a whole number from 0 to " + std::to_string(kMaxBodies)};
  return count;
}

Error unknown_scene(const std::string& spec) {
  const std::vector<SceneRow> table = scene_table();
  std::vector<std::string_view> known;
  for (const SceneRow& row : table) known.push_back(row.example);
  return {"no such scene", "scene '" + spec + "'",
          core::advise_name(spec, known) + "; or give the path of a file that ends in .toml"};
}

Result<Scene> by_name(const std::string& spec, const SceneOptions& options) {
  for (const SmallSceneRow& row : small_scenes()) {
    if (row.name != spec) continue;
    Scene scene = row.make();
    scene.name = std::string(row.name);
    scene.description = std::string(row.what);
    scene.frames = options.frames.value_or(scene.frames);
    scene.seed = options.seed.value_or(scene.seed);
    return scene;
  }
  const std::vector<std::string_view> parts = split(spec);
  for (const MeshSceneRow& row : kMeshScenes) {
    if (row.family != parts[0]) continue;
    if (parts.size() != 3)
      return Error{"the name is not of the form " + std::string(row.row.pattern), "scene '" + spec + "'",
                   "for example " + std::string(row.row.example)};
    const Result<std::uint32_t> count = body_count(parts[2], spec);
    if (!count) return count.error();
    return row.make(parts[1], count.value(), options);
  }
  return unknown_scene(spec);
}

}  // namespace

std::vector<SceneRow> scene_table() {
  std::vector<SceneRow> table;
  for (const MeshSceneRow& row : kMeshScenes) table.push_back(row.row);
  for (const SmallSceneRow& row : small_scenes()) table.push_back({row.name, row.name, row.what});
  return table;
}

Result<Scene> make_scene(const std::string& spec, const SceneOptions& options) {
  if (spec.ends_with(".toml")) return read_scene_file(spec, options);
  Result<Scene> scene = by_name(spec, options);
  if (!scene) return scene;
  if (core::Status s = core::check_scene(scene.value()); !s) return s.error();
  return scene;
}

}  // namespace broadside::datasets
