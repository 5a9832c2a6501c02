#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cli/commands.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/mesh/mesh_facts.hpp"

namespace broadside::bench {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson facts_of(const core::Mesh& mesh, const datasets::MeshFacts& f) {
  const auto triple = [](core::Vec3 v) { return OrderedJson{v.x, v.y, v.z}; };
  const core::Topology& t = f.topology;
  return {{"name", mesh.name},
          {"source", mesh.source},
          {"stand_in", mesh.is_stand_in},
          {"vertices", f.vertices},
          {"triangles", f.triangles},
          {"edges", t.edges},
          {"components", t.components},
          {"euler_characteristic", t.euler_characteristic},
          {"manifold", t.is_manifold()},
          {"closed", t.is_closed()},
          {"boundary_edges", t.boundary_edges},
          {"non_manifold_edges", t.non_manifold_edges},
          {"non_manifold_vertices", t.non_manifold_vertices},
          {"misoriented_edges", t.misoriented_edges},
          {"degenerate_triangles", f.dropped.collapsed_triangles + f.dropped.zero_area_triangles},
          {"dropped_on_reading", f.dropped.text()},
          {"self_intersecting_pairs", f.self_intersecting_pairs ? OrderedJson(*f.self_intersecting_pairs)
                                                                : OrderedJson("not counted: built without CGAL")},
          {"min", triple(f.bounds.min)},
          {"max", triple(f.bounds.max)},
          {"area", f.area_m2},
          {"volume", f.volume_m3},
          {"mean_edge", f.mean_edge_m},
          {"covering_radius", f.covering_radius_m}};
}

std::string fact_text(const OrderedJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const OrderedJson& item : value) text += (text.empty() ? "" : " ") + fmt::format("{:.9g}", item.get<double>());
  return text;
}

core::Exit show_mesh(const std::string& name, bool as_json) {
  auto loaded = datasets::acquire_loaded_mesh(name, datasets::MeshOptions::from_environment());
  if (!loaded) return complain(loaded.error());
  const core::Mesh& mesh = loaded.value().mesh;
  const OrderedJson facts = facts_of(mesh, datasets::mesh_facts(mesh, loaded.value().dropped, true));
  if (as_json) {
    fmt::print("{}\n", facts.dump(2));
    return core::Exit::kGood;
  }
  for (const auto& [key, value] : facts.items()) fmt::print("{:<24} {}\n", key, fact_text(value));
  if (!facts["closed"].get<bool>() || facts["misoriented_edges"] != 0)
    fmt::print("\nThe surface encloses no volume: the number is the sum over its triangles, each with the origin.\n");
  return core::Exit::kGood;
}

}  // namespace

void add_mesh(CLI::App& program, core::Exit& exit) {
  auto name = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand(
      "mesh", "Describe a mesh: counts, topology, degenerate and crossing triangles, volume, covering radius");
  command->add_option("MESH", *name, "A mesh file, or a name of the catalogue (broadside list meshes)")->required();
  command->add_flag("--json", *as_json, "As JSON");
  command->callback([name, as_json, &exit] { exit = show_mesh(*name, *as_json); });
}

}  // namespace broadside::bench
