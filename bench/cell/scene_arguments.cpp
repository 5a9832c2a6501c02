#include "bench/cell/scene_arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/step_suffix.hpp"
#include "bench/cell/trace_scene.hpp"
#include "bench/cell/transformed_spec.hpp"
#include "bench/engines.hpp"
#include "core/engine/settings.hpp"
#include "core/nearest_name.hpp"
#include "datasets/scenes.hpp"

namespace broadside::bench {
namespace {

bool has_key(const core::EngineRow& row, const std::string& key) {
  return std::any_of(row.settings.begin(), row.settings.end(), [&](const auto& s) { return s.key == key; });
}

// A setting that was given for all engines goes to those that have its key.
core::Status spread(const std::string& text, std::vector<CellSpec>& cells) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return core::Error{"cannot read '" + text + "'", "--set", "write it as key=value"};
  const std::string key = text.substr(0, equals);
  bool is_known = false;
  std::vector<std::string_view> keys;
  for (CellSpec& cell : cells) {
    for (const core::SettingRow& s : cell.row->settings) keys.push_back(s.key);
    if (!has_key(*cell.row, key)) continue;
    cell.settings[key] = text.substr(equals + 1);
    is_known = true;
  }
  if (is_known) return core::Done{};
  return core::Error{"none of the engines has a setting '" + key + "'", "--set",
                     keys.empty() ? "they have no settings" : core::advise_name(key, keys)};
}

}  // namespace

void SceneArguments::add_to(CLI::App& command) {
  command
      .add_option(
          "SCENE", spec,
          "A scene's name, such as freefall:bunny:50 or tower:cube:20[offset=0.2,seed=7], a .toml, .gltf or .glb "
          "file, or a trace (.h5), whose scene is taken (broadside list scenes); "
          "@mirrored-x, @turned-x, @doubled, @renumbered or @grown after it: the scene transformed; @1/240: in steps of "
          "1/240 s")
      ->required();
  command.add_option("--frames", frames, "Frames to simulate (default: the scene's own)")
      ->check(more_than_zero, "POSITIVE");
  command.add_flag("--stand-in", allow_stand_in,
                   "Use a procedural body of the same size class where a mesh is not on this machine; reports say so");
}

core::Result<core::Scene> SceneArguments::make() const {
  if (const auto [untold, transformation] = split_transformation(spec); transformation != nullptr) {
    SceneArguments plain = *this;
    plain.spec = untold;
    auto scene = plain.make();
    if (!scene) return scene.error();
    core::Scene other = transformation->apply(scene.value());
    other.name += "@" + std::string(transformation->name);
    return other;
  }
  if (const auto [untold, dt_s] = split_step(spec); dt_s) {
    SceneArguments plain = *this;
    plain.spec = untold;
    plain.frames = 0;
    auto scene = plain.make();
    if (!scene) return scene.error();
    auto other = scene_at_step(std::move(scene).value(), *dt_s);
    if (!other) return other.error();
    other.value().name += spec.substr(untold.size());
    if (frames > 0) other.value().frames = frames;
    return other;
  }
  if (is_trace_file(spec)) {
    auto scene = scene_of_trace(spec);
    if (scene.ok() && frames > 0) scene.value().frames = frames;
    return scene;
  }
  datasets::SceneOptions options;
  options.meshes.allow_procedural = allow_stand_in;
  if (frames > 0) options.frames = frames;
  return datasets::make_scene(spec, options);
}

void EngineArguments::add_to(CLI::App& command) {
  command
      .add_option("--engine", engines,
                  "An engine, such as octree-cpu or octree-cpu[levels=A], a plug-in ./libmine.so, or a program "
                  "'node mine.mjs'; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--engines", file, "A file with an engine a line, written as for --engine; # begins a remark");
  command.add_option("--set", settings, "key=value for every engine that has the key; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

core::Result<std::vector<std::string>> EngineArguments::all() const {
  std::vector<std::string> named = engines;
  if (!file.empty()) {
    std::ifstream in(file);
    if (!in) return core::Error{"cannot read it", file, "name a file with an engine a line"};
    for (std::string line; std::getline(in, line);) {
      const auto first = line.find_first_not_of(" \t\r");
      if (first == std::string::npos || line[first] == '#') continue;
      named.push_back(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
    }
  }
  if (named.empty())
    return core::Error{"no engine was named", file.empty() ? "--engine" : file,
                       "name one that 'broadside list engines' shows"};
  return named;
}

core::Result<std::vector<CellSpec>> EngineArguments::make() const {
  std::vector<CellSpec> cells;
  auto named = all();
  if (!named) return named.error();
  for (const std::string& text : named.value()) {
    auto cell = parse_cell_spec(text);
    if (!cell) return cell.error();
    cells.push_back(std::move(cell).value());
  }
  for (const std::string& text : settings)
    if (core::Status s = spread(text, cells); !s) return s.error();
  for (const CellSpec& cell : cells) {
    auto parsed = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
    if (!parsed) return parsed.error();
  }
  return cells;
}

}  // namespace broadside::bench
