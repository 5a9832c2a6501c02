#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "core/trace/box_file.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace broadside::bench {
namespace {

struct ExportArguments {
  SceneArguments scene;
  std::string folder = "out/export";
};

// A file name made from a scene's name: all but letters, digits, dots and dashes becomes an underscore.
std::string stem_of(const std::string& name) {
  std::string stem = std::filesystem::path(name).filename().string();
  for (const char* ending : {".toml", ".gltf", ".glb"})
    if (stem.ends_with(ending)) stem.resize(stem.size() - std::string(ending).size());
  for (char& c : stem)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  return stem.empty() ? "scene" : stem;
}

bool is_box_stream(const std::string& spec) {
  for (const datasets::BoxStreamRow& row : datasets::box_stream_table())
    if (spec.starts_with(row.prefix())) return true;
  return false;
}

core::Exit export_boxes(const ExportArguments& a) {
  auto made = datasets::make_box_stream(a.scene.spec);
  if (!made) return complain(made.error());
  datasets::BoxStream& stream = made.value();
  const std::uint32_t frames = a.scene.frames > 0 ? std::min(a.scene.frames, stream.frames) : stream.frames;
  const std::filesystem::path path = std::filesystem::path(a.folder) / (stem_of(a.scene.spec) + ".h5");
  std::uint32_t frame = 0;
  const auto next = [&]() -> core::Result<std::vector<core::Box>> {
    if (frame++ > 0)
      if (core::Status s = stream.advance(stream.boxes); !s) return s.error();
    return stream.boxes;
  };
  if (core::Status s = core::write_box_file(path, frames, next); !s) return complain(s.error());
  fmt::print("{}: {} boxes, {} frame(s)\n", path.string(), stream.boxes.size(), frames);
  return core::Exit::kGood;
}

core::Exit export_scene(const ExportArguments& a) {
  auto scene = a.scene.make();
  if (!scene) return complain(scene.error());
  const std::filesystem::path path = std::filesystem::path(a.folder) / (stem_of(a.scene.spec) + ".toml");
  if (core::Status s = datasets::write_scene_file(scene.value(), path); !s) return complain(s.error());
  fmt::print("{}: {} bodies, {} mesh file(s), digest {:#018x}\n", path.string(), scene.value().bodies.size(),
             scene.value().meshes.size(), core::scene_digest(scene.value()));
  return core::Exit::kGood;
}

core::Exit export_any(const ExportArguments& a) {
  std::error_code failed;
  std::filesystem::create_directories(a.folder, failed);
  if (failed) return complain({"cannot be made: " + failed.message(), a.folder, "check the path and its permissions"});
  return is_box_stream(a.scene.spec) ? export_boxes(a) : export_scene(a);
}

}  // namespace

void add_export(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand(
      "export",
      "Write a scene as TOML with its meshes as binary PLY, or a stream of boxes as HDF5, for others to load");
  a->scene.add_to(*command);
  command->add_option("--out", a->folder, "Folder for the files")->capture_default_str();
  command->callback([a, &exit] { exit = export_any(*a); });
}

}  // namespace broadside::bench
