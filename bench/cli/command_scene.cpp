#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/scene_picture.hpp"
#include "bench/engines.hpp"
#include "core/scene/shapes.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

struct SceneCommand {
  SceneArguments scene;
  std::string picture;
  std::uint32_t after = 0;
  bool as_json = false;
};

using OrderedJson = nlohmann::ordered_json;

OrderedJson triple(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

OrderedJson facts_of(const core::Scene& scene) {
  std::uint64_t still = 0;
  for (const core::Body& body : scene.bodies) still += body.inverse_mass > 0.0F ? 0 : 1;
  OrderedJson meshes = OrderedJson::array();
  for (const auto& mesh : scene.meshes)
    meshes.push_back({{"name", mesh->name},
                      {"source", mesh->source},
                      {"stand_in", mesh->is_stand_in},
                      {"vertices", mesh->vertices.size()},
                      {"triangles", mesh->triangles.size()}});
  return {{"name", scene.name},
          {"what", scene.description},
          {"bodies", scene.bodies.size()},
          {"static_bodies", still},
          {"domain_min_m", triple(scene.domain.min)},
          {"domain_max_m", triple(scene.domain.max)},
          {"gravity_m_s2", triple(scene.gravity_m_s2)},
          {"dt_s", scene.dt_s},
          {"frames", scene.frames},
          {"seed", scene.seed},
          {"theta_m", scene.parameters.theta_m},
          {"digest", fmt::format("{:#018x}", core::scene_digest(scene))},
          {"motion", std::string(core::motion_word(scene.motion))},
          {"answer", scene.answer},
          {"wrenches", scene.wrenches.size()},
          {"inertia_notes", core::hull_notes(scene)},
          {"meshes", meshes}};
}

void print_facts(const OrderedJson& facts) {
  for (const auto& [key, value] : facts.items())
    if (key != "meshes" && key != "inertia_notes")
      fmt::print("{:<14} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  for (const OrderedJson& note : facts["inertia_notes"]) fmt::print("note           {}\n", note.get<std::string>());
  for (const OrderedJson& mesh : facts["meshes"])
    fmt::print("mesh           {}: {} vertices, {} triangles, {}{}\n", mesh["name"].get<std::string>(),
               mesh["vertices"].get<std::uint64_t>(), mesh["triangles"].get<std::uint64_t>(),
               mesh["source"].get<std::string>(), mesh["stand_in"].get<bool>() ? " (STAND-IN)" : "");
}

core::Result<ScenePanel> panel_after(const core::Scene& scene, std::uint32_t frames) {
  auto row = find_engine("octree-cpu");
  if (!row) return row.error();
  auto settings = core::Settings::parse(row.value()->id, row.value()->settings, {});
  if (!settings) return settings.error();
  auto engine = row.value()->create(settings.value());
  if (!engine) return engine.error();
  core::Dynamics& dynamics = *engine.value().dynamics;
  if (core::Status s = dynamics.load(scene); !s) return s.error();
  for (std::uint32_t k = 0; k < frames; ++k)
    if (core::Status s = dynamics.step(scene.dt_s); !s) return s.error();
  core::FrameRecord frame;
  if (core::Status s = dynamics.read_back(frame, core::RecordLevel::kFull); !s) return s.error();
  return ScenePanel{fmt::format("after {} frames, {:.1f} s (octree-cpu)", frames, frames * scene.dt_s), frame.position,
                    frame.orientation};
}

core::Status write_picture(const core::Scene& scene, const SceneCommand& a) {
  if (std::filesystem::path(a.picture).extension() != ".svg")
    return core::Error{"a picture's name ends in .svg", a.picture, "add the ending"};
  // Ten thousand boxes are 2 MB, and smaller than a pixel.
  if (scene.bodies.size() > 10'000)
    return core::Error{"a picture shows at most 10000 bodies", scene.name, "ask for fewer"};
  std::vector<ScenePanel> panels(1);
  panels[0].caption = "start";
  for (const core::Body& body : scene.bodies) {
    panels[0].positions.push_back(body.position);
    panels[0].orientations.push_back(body.orientation);
  }
  if (a.after > 0) {
    auto later = panel_after(scene, a.after);
    if (!later) return later.error();
    panels.push_back(std::move(later).value());
  }
  return core::write_whole_file(a.picture, scene_svg(scene, panels));
}

core::Exit show_scene(const SceneCommand& a) {
  auto scene = a.scene.make();
  if (!scene) return complain(scene.error());
  const OrderedJson facts = facts_of(scene.value());
  if (a.as_json)
    fmt::print("{}\n", facts.dump(2));
  else
    print_facts(facts);
  if (a.picture.empty()) return core::Exit::kGood;
  if (core::Status s = write_picture(scene.value(), a); !s) return complain(s.error());
  return core::Exit::kGood;
}

}  // namespace

void add_scene(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<SceneCommand>();
  CLI::App* command = program.add_subcommand("scene", "Describe a scene, and draw a picture of it");
  a->scene.add_to(*command);
  command->add_option("--picture", a->picture, "Write an SVG picture of its start here");
  command->add_option("--after", a->after, "Add a second panel to the picture: after this many frames of octree-cpu");
  command->add_flag("--json", a->as_json, "As JSON");
  command->callback([a, &exit] { exit = show_scene(*a); });
}

}  // namespace broadside::bench
