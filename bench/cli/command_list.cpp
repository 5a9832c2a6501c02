#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/cli/commands.hpp"
#include "bench/engines.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/mesh/mesh_catalogue.hpp"
#include "datasets/scenes.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {
namespace {

// Every list is rows of {name, what} and some facts.
using Rows = nlohmann::ordered_json;

Rows engine_rows() {
  Rows rows = Rows::array();
  for (const core::EngineRow& engine : engines()) {
    const std::string reason = why_absent(engine);
    Rows settings = Rows::array();
    for (const core::SettingRow& s : engine.settings)
      settings.push_back({{"key", s.key}, {"default", s.default_value}, {"allowed", s.allowed}, {"what", s.what}});
    rows.push_back({{"name", engine.id},
                    {"what", engine.what},
                    {"offers", engine.capabilities},
                    {"here", reason.empty() ? "yes" : "no: " + reason},
                    {"settings", settings}});
  }
  return rows;
}

Rows knob_rows(std::span<const datasets::SceneKnob> knobs) {
  Rows rows = Rows::array();
  for (const datasets::SceneKnob& k : knobs)
    rows.push_back({{"key", k.key},
                    {"default", fmt::format("{}", k.usual)},
                    {"allowed", {fmt::format("{} to {}", k.low, k.high)}},
                    {"what", k.what}});
  return rows;
}

Rows scene_rows() {
  Rows rows = Rows::array();
  for (const datasets::SceneRow& scene : datasets::scene_table())
    rows.push_back({{"name", scene.pattern},
                    {"what", scene.what},
                    {"example", scene.example},
                    {"options", knob_rows(scene.knobs)}});
  for (const datasets::BoxStreamRow& stream : datasets::box_stream_table())
    rows.push_back({{"name", stream.pattern}, {"what", stream.what}, {"example", stream.example}});
  return rows;
}

Rows validator_rows() {
  Rows rows = Rows::array();
  for (const validation::ValidatorRow& v : validation::validators())
    rows.push_back({{"name", v.name}, {"what", v.law}, {"must reject", v.must_reject}});
  return rows;
}

Rows file_rows(const datasets::MeshRow& mesh) {
  Rows files = Rows::array();
  for (const datasets::MeshFile& file : mesh.files) {
    Rows row{{"file", file.file},
             {"what", file.what},
             {"sha256", file.sha256.empty() ? "of its own, beside it" : std::string(file.sha256)},
             {"vertices", file.vertices},
             {"triangles", file.triangles},
             {"boundary_edges", file.boundary_edges},
             {"stand_in", file.is_stand_in}};
    if (file.covering_radius > 0.0) {
      row["euler_characteristic"] = file.euler_characteristic;
      row["covering_radius"] = file.covering_radius;
    }
    if (const datasets::MeshSource* source = file.source)
      row["source"] = {
          {"package", fmt::format("{} {} {}", source->is_npm ? "npm" : "apt", source->package, source->version)},
          {"path", std::string(source->member) + (source->inner.empty() ? "" : " -> ") + std::string(source->inner)},
          {"sha256", source->sha256}};
    files.push_back(row);
  }
  return files;
}

Rows mesh_rows() {
  Rows rows = Rows::array();
  for (const datasets::MeshRow& mesh : datasets::mesh_catalogue())
    rows.push_back({{"name", mesh.name},
                    {"what", mesh.what},
                    {"vertices", mesh.vertices},
                    {"triangles", mesh.triangles},
                    {"credit", mesh.credit},
                    {"files", file_rows(mesh)}});
  return rows;
}

struct ListRow {
  const char* name;
  Rows (*make)();
};
constexpr std::array<ListRow, 4> kLists{
    {{"engines", engine_rows}, {"scenes", scene_rows}, {"validators", validator_rows}, {"meshes", mesh_rows}}};

std::string value_text(const Rows& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_rows(const Rows& rows) {
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row["name"].get<std::string>().size());
  for (const auto& row : rows) {
    fmt::print("  {:<{}}  {}\n", row["name"].get<std::string>(), width, row["what"].get<std::string>());
    for (const auto& [key, value] : row.items()) {
      if (key == "name" || key == "what" || (value.is_string() && value.get<std::string>().empty())) continue;
      if (!value.is_array()) {
        fmt::print("  {:<{}}    {}: {}\n", "", width, key, value_text(value));
        continue;
      }
      for (const auto& item : value) {
        if (!item.contains("key")) {
          fmt::print("  {:<{}}    {}: {}\n", "", width, item["file"].get<std::string>(),
                     item["what"].get<std::string>());
          continue;
        }
        std::string allowed;
        for (const auto& a : item["allowed"]) allowed += (allowed.empty() ? "" : "|") + a.get<std::string>();
        fmt::print("  {:<{}}    {}={} (default {}): {}\n", "", width, item["key"].get<std::string>(),
                   allowed.empty() ? "N" : allowed, item["default"].get<std::string>(),
                   item["what"].get<std::string>());
      }
    }
  }
}

core::Exit list(const std::string& which, bool as_json) {
  Rows all = Rows::object();
  for (const ListRow& row : kLists)
    if (which.empty() || which == row.name) all[row.name] = row.make();
  if (as_json) {
    fmt::print("{}\n", all.dump(2));
    return core::Exit::kGood;
  }
  for (const auto& [name, rows] : all.items()) {
    fmt::print("{}\n", name);
    print_rows(rows);
  }
  return core::Exit::kGood;
}

}  // namespace

void add_list(CLI::App& program, core::Exit& exit) {
  auto which = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand("list", "List engines and their settings, scenes, validators and meshes");
  command->add_option("WHAT", *which, "engines, scenes, validators or meshes (default: all)")
      ->check(CLI::IsMember({"engines", "scenes", "validators", "meshes"}));
  command->add_flag("--json", *as_json, "As JSON");
  command->callback([which, as_json, &exit] { exit = list(*which, *as_json); });
}

}  // namespace broadside::bench
