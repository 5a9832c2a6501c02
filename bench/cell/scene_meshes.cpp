#include "bench/cell/scene_meshes.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <set>
#include <string>
#include <string_view>

#include "datasets/fetch/fetch_mesh.hpp"
#include "datasets/mesh/acquire_mesh.hpp"

namespace broadside::bench {
namespace {

void fetch_what_it_names(const std::string& spec) {
  static std::set<std::string, std::less<>> tried;
  for (const std::string_view mesh : datasets::fetchable_meshes()) {
    if (spec.find(":" + std::string(mesh) + ":") == std::string::npos || !tried.emplace(mesh).second) continue;
    const auto say = [&](std::string_view step) { fmt::print(stderr, "fetching {}: {}\n", mesh, step); };
    const auto cache = datasets::MeshOptions::from_environment().cache_dir;
    if (core::Status s = datasets::fetch_mesh(mesh, cache, say); !s)
      fmt::print(stderr, "broadside: {}\n", s.error().line());
  }
}

}  // namespace

core::Result<core::Scene> make_scene_with_meshes(const SceneArguments& wanted) {
  SceneArguments exact = wanted;
  exact.allow_stand_in = false;
  auto scene = exact.make();
  if (scene.ok()) return scene;
  fetch_what_it_names(wanted.spec);
  scene = exact.make();
  if (scene.ok() || !wanted.allow_stand_in) return scene;
  auto with_stand_in = wanted.make();
  if (with_stand_in.ok()) fmt::print(stderr, "broadside: a procedural body stands in: {}\n", scene.error().line());
  return with_stand_in;
}

}  // namespace broadside::bench
