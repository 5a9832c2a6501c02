#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest_name.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/start_grid.hpp"
#include "datasets/scene_file/document.hpp"
#include "datasets/scene_file/force_tables.hpp"
#include "datasets/scene_file/import_scene.hpp"
#include "datasets/scene_file/mesh_table.hpp"
#include "datasets/scene_file/scene_file.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::datasets {
namespace {

using core::Body;
using core::Material;
using core::Result;
using core::Scene;

std::vector<std::string_view> generator_names() {
  std::vector<std::string_view> names{"stacked-grid", "filled-cube"};
  for (const SceneFamily& family : scene_families()) names.push_back(family.name);
  return names;
}

class SceneFileReader {
 public:
  SceneFileReader(std::filesystem::path path, const SceneOptions& options)
      : path_(std::move(path)), options_(options), errors_{path_.string(), {}} {}

  Result<Scene> read(const Node& root) {
    TableReader top(root, "the scene", errors_);
    read_scalars(top);
    read_domain(top);
    has_gravity_ = top.has("gravity_m_s2");
    has_face_material_ = top.has("face_material");
    if (const Node* node = top.table("parameters")) read_parameters(*node);
    if (const Node* node = top.table("face_material")) read_material(*node, scene_.face_material);
    if (const Node* node = top.table("material")) read_material(*node, material_);
    lines_["parameters"] = top.line_of("parameters");
    lines_["faces"] = top.line_of("face_material");
    for (const Node* node : top.tables("mesh")) read_mesh(*node);
    if (const Node* node = top.table("generator")) read_generator(*node);
    if (const Node* node = top.table("import")) read_import(*node);
    for (const Node* node : top.tables("body")) read_body(*node);
    complete_mass();
    for (const Node* node : top.tables("spring")) {
      lines_["spring " + std::to_string(scene_.springs.size())] = node->line;
      scene_.springs.push_back(read_spring_table(*node, errors_));
    }
    for (const Node* node : top.tables("wrench")) {
      lines_["wrench " + std::to_string(scene_.wrenches.size())] = node->line;
      scene_.wrenches.push_back(read_wrench_table(*node, errors_));
    }
    top.finish();
    if (!has_domain_)
      errors_.add(1, "the scene has no domain", "add [domain] with min_m and max_m, or a generator that makes one");
    if (errors_.first) return *errors_.first;
    return checked();
  }

 private:
  void read_scalars(TableReader& top) {
    scene_.name = path_.stem().string();
    scene_.seed = kDefaultSeed;
    top.text("name", scene_.name);
    top.text("description", scene_.description);
    top.whole("frames", 1U, std::numeric_limits<std::uint32_t>::max(), scene_.frames);
    read_seed(top);
    top.number("dt_s", scene_.dt_s);
    top.vec3("gravity_m_s2", scene_.gravity_m_s2);
    top.text("answer", scene_.answer);
    read_motion(top);
    for (const char* key : {"dt_s", "gravity_m_s2"}) lines_[key] = top.line_of(key);
    scene_.frames = options_.frames.value_or(scene_.frames);
    scene_.seed = options_.seed.value_or(scene_.seed);
  }

  void read_motion(TableReader& top) {
    std::string word;
    if (!top.text("motion", word)) return;
    constexpr std::array kMotionKinds{core::Motion::kTranslate, core::Motion::kRigid};
    std::vector<std::string_view> known;
    for (const core::Motion motion : kMotionKinds) {
      known.push_back(core::motion_word(motion));
      if (known.back() == word) scene_.motion = motion;
    }
    if (core::motion_word(scene_.motion) != word)
      top.fail("motion", "there is no motion '" + word + "'", core::advise_name(word, known));
  }

  // Where one body gives an inertia, every other body gets that of its mesh.
  void read_mass(TableReader& table, const Body& body) {
    std::vector<double> inertia;
    std::vector<double> center;
    const bool has_inertia = table.numbers("inertia_kg_m2", 6, inertia);
    const bool has_center = table.numbers("center_of_mass_m", 3, center);
    if (has_center && !has_inertia)
      table.fail("center_of_mass_m", "it is given without the inertia",
                 "give inertia_kg_m2 = [xx, yy, zz, xy, xz, yz]");
    if (!has_inertia || errors_.first) return;
    core::MassProperties given;
    std::copy(inertia.begin(), inertia.end(), given.inertia_kg_m2.begin());
    std::copy(center.begin(), center.end(), given.center_of_mass_m.begin());
    if (!(body.inverse_mass > 0.0F)) table.fail("inertia_kg_m2", "a static body has an inertia", "leave it out");
    given_mass_[scene_.bodies.size()] = given;
  }

  void complete_mass() {
    if (given_mass_.empty() || errors_.first) return;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const auto given = given_mass_.find(i);
      if (given != given_mass_.end()) {
        scene_.mass_properties.push_back(given->second);
        continue;
      }
      core::MassProperties derived;
      if (scene_.bodies[i].inverse_mass > 0.0F) {
        Scene without = scene_;
        without.mass_properties.clear();
        const auto made = core::mass_properties_of(without, i);
        if (!made) return errors_.add(1, made.error().what, made.error().advice);
        derived = made.value();
      }
      scene_.mass_properties.push_back(derived);
    }
  }

  // TOML's whole numbers end at 2^63 - 1; a larger seed is written as a string of digits.
  void read_seed(TableReader& top) {
    constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (!top.is_text("seed")) {
      top.whole("seed", std::uint64_t{0}, kMost, scene_.seed);
      return;
    }
    std::string digits;
    top.text("seed", digits);
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), scene_.seed);
    if (failed != std::errc() || end != digits.data() + digits.size())
      top.fail("seed", "seed is '" + digits + "'", "give a whole number from 0 to 18446744073709551615");
  }

  void read_domain(TableReader& top) {
    const Node* node = top.table("domain");
    if (node == nullptr) return;
    TableReader domain(*node, "the domain", errors_);
    lines_["domain"] = domain.line();
    has_domain_ = domain.vec3("min_m", scene_.domain.min);
    has_domain_ = domain.vec3("max_m", scene_.domain.max) && has_domain_;
    domain.finish();
    if (!has_domain_) errors_.add(node->line, "the domain is not complete", "give min_m and max_m");
  }

  void read_parameters(const Node& node) {
    TableReader table(node, "the parameters", errors_);
    core::Parameters& p = scene_.parameters;
    table.number("delta_m", p.delta_m);
    table.number("beta", p.beta);
    table.number("alpha", p.alpha);
    table.number("v_threshold_m_s", p.v_threshold_m_s);
    table.number("impulse_min_n_s", p.impulse_min_n_s);
    table.number("v_max_m_s", p.v_max_m_s);
    table.number("epsilon_m", p.epsilon_m);
    has_theta_ = table.number("theta_m", p.theta_m);
    table.number("hash_cell_m", p.hash_cell_m);
    table.finish();
  }

  void read_material(const Node& node, Material& material) {
    TableReader table(node, "the material", errors_);
    table.number("mu_static", material.mu_static);
    table.number("mu_kinetic", material.mu_kinetic);
    table.number("restitution", material.restitution);
    table.finish();
  }

  void read_mesh(const Node& node) {
    if (errors_.first) return;
    std::optional<core::Mesh> mesh = read_mesh_table(node, path_.parent_path(), options_.meshes, errors_);
    if (!mesh) return;
    for (const auto& known : scene_.meshes)
      if (known->name == mesh->name)
        errors_.add(node.line, "a second mesh is named '" + mesh->name + "'", "give each mesh a name of its own");
    lines_["mesh " + mesh->name] = node.line;
    scene_.meshes.push_back(std::make_shared<const core::Mesh>(std::move(*mesh)));
  }

  // The index of the mesh that the table names; the name is optional when there is only one mesh.
  std::uint32_t mesh_of(TableReader& table) {
    std::string name;
    const bool is_named = table.text("mesh", name);
    std::vector<std::string_view> known;
    for (const auto& mesh : scene_.meshes) known.push_back(mesh->name);
    if (!is_named && known.size() != 1) {
      table.fail("mesh", known.empty() ? "there is no [[mesh]]" : "it does not say which mesh",
                 known.empty() ? "add one" : "give mesh = \"" + std::string(known[0]) + "\"");
      return 0;
    }
    if (!is_named) return 0;
    for (std::uint32_t m = 0; m < known.size(); ++m)
      if (known[m] == name) return m;
    table.fail("mesh", "there is no mesh '" + name + "' in this scene", core::advise_name(name, known));
    return 0;
  }

  // Reads the keys that generated and written bodies share.
  Body body_of(TableReader& table) {
    Body body;
    body.material = material_;
    body.mesh = mesh_of(table);
    bool is_static = false;
    double mass_kg = 1.0;
    table.flag("static", is_static);
    const bool has_mass = table.positive("mass_kg", mass_kg);
    if (is_static && has_mass) table.fail("mass_kg", "a static body has a mass", "give static = true or mass_kg");
    body.inverse_mass = is_static ? 0.0F : static_cast<float>(1.0 / mass_kg);
    if (!is_static && !(body.inverse_mass > 0.0F && std::isfinite(body.inverse_mass)))
      table.fail("mass_kg", "1 / mass_kg is outside the range of a 32-bit float", "give a mass from 1e-37 to 1e37 kg");
    if (const Node* node = table.table("material")) read_material(*node, body.material);
    return body;
  }

  void read_body(const Node& node) {
    if (errors_.first) return;
    TableReader table(node, "this body", errors_);
    Body body = body_of(table);
    if (!table.vec3("position_m", body.position) && !errors_.first)
      errors_.add(node.line, "the body has no position", "give position_m = [x, y, z]");
    table.vec3("velocity_m_s", body.velocity);
    table.vec3("angular_velocity_rad_s", body.angular_velocity);
    std::vector<double> q;
    if (table.numbers("orientation_wxyz", 4, q)) body.orientation = unit(table, q);
    read_mass(table, body);
    bool is_fast = false;
    table.flag("fast", is_fast);
    table.finish();
    lines_["body " + std::to_string(scene_.bodies.size())] = node.line;
    scene_.bodies.push_back(body);
    if (is_fast || !scene_.is_fast.empty()) scene_.is_fast.resize(scene_.bodies.size());
    if (is_fast) scene_.is_fast.back() = 1;
  }

  // Rounded once from the normalized doubles; the written digits are rarely an exact unit quaternion.
  core::Quat unit(TableReader& table, const std::vector<double>& q) {
    const double norm = std::sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
    // More than a part in a thousand is not the rounding of written digits.
    if (!(std::abs(norm - 1.0) <= 1e-3)) {
      table.fail("orientation_wxyz", "orientation_wxyz is not a unit quaternion", "normalize w, x, y, z");
      return {};
    }
    // Already a unit quaternion in float: taken unchanged, so that a written scene reads back to the same bits.
    const double n = std::abs(norm * norm - 1.0) <= 4.0 * 0x1p-24 ? 1.0 : norm;
    return {static_cast<float>(q[0] / n), static_cast<float>(q[1] / n), static_cast<float>(q[2] / n),
            static_cast<float>(q[3] / n)};
  }

  void read_generator(const Node& node) {
    if (errors_.first) return;
    TableReader table(node, "the generator", errors_);
    std::string kind;
    std::uint32_t count = 0;
    if (!table.text("kind", kind)) errors_.add(node.line, "the generator has no kind", "give kind = \"stacked-grid\"");
    if (!table.whole("count", 0U, kMaxBodies, count) && !errors_.first)
      errors_.add(node.line, "the generator has no count", "give count = 50");
    if (errors_.first) return;
    if (const SceneFamily* family = find_family(kind)) return read_family(table, *family, count);
    const Body body = body_of(table);
    StackedGrid grid;
    FilledCube cube;
    if (kind == "stacked-grid") {
      table.number("gap", grid.gap);
      table.number("drop_m", grid.drop_m);
      table.number("jitter", grid.jitter);
      table.number("width_of_grid", grid.width_of_grid);
      if (!(grid.gap >= 0.0)) table.fail("gap", "gap is negative", "give 0 or more");
      if (!(grid.drop_m >= 0.0)) table.fail("drop_m", "drop_m is negative", "give 0 or more, in m");
      if (!(grid.jitter >= 0.0)) table.fail("jitter", "jitter is negative", "give 0 or more");
      if (!(grid.width_of_grid >= 1.0)) table.fail("width_of_grid", "width_of_grid is below 1", "give 1 or more");
    } else if (kind == "filled-cube") {
      table.positive("fill", cube.fill);
      table.number("top_speed_m_s", cube.top_speed_m_s);
      // Above a half, the grid of cells rarely fits, and the cube would grow without a notice.
      if (!(cube.fill <= 0.5)) table.fail("fill", "fill is above 0.5", "give a share of the volume up to 0.5");
      if (!(cube.top_speed_m_s >= 0.0)) table.fail("top_speed_m_s", "top_speed_m_s is negative", "give 0 or more");
    } else if (!errors_.first) {
      table.fail("kind", "no such generator '" + kind + "'", core::advise_name(kind, generator_names()));
    }
    table.finish();
    if (errors_.first) return;
    const core::Box box = core::bounds(*scene_.meshes[body.mesh]);
    place(kind == "stacked-grid" ? stacked_grid(box, count, grid, scene_.seed)
                                 : filled_cube(box, count, cube, scene_.seed),
          body);
  }

  void read_import(const Node& node) {
    if (errors_.first) return;
    TableReader table(node, "the import", errors_);
    std::string file;
    if (!table.text("file", file)) errors_.add(node.line, "the import has no file", "give file = \"scene.gltf\"");
    table.finish();
    if (errors_.first) return;
    const Result<Scene> made = import_scene(path_.parent_path() / file);
    if (!made) return errors_.add(node.line, made.error().where + ": " + made.error().what, made.error().advice);
    adopt(made.value());
  }

  void read_family(TableReader& table, const SceneFamily& family, std::uint32_t count) {
    const std::uint32_t model = mesh_of(table);
    std::vector<double> knobs;
    for (const SceneKnob& knob : family.knobs) {
      double value = knob.usual;
      table.number(knob.key, value);
      if (!(value >= knob.low && value <= knob.high))
        table.fail(knob.key, std::string(knob.key) + " is out of range", std::string(knob.what));
      knobs.push_back(value);
    }
    table.finish();
    if (errors_.first) return;
    const Scene made = family.make({scene_.meshes[model], count, scene_.seed, knobs});
    // A scene of this generator alone has only the generator's meshes: no body of mixed-sizes has the model's own size.
    if (scene_.meshes.size() == 1) scene_.meshes.clear();
    adopt(made);
  }

  // Takes bodies and their meshes from the made scene, and every setting that this file does not give.
  void adopt(const Scene& made) {
    std::vector<std::uint32_t> index;
    for (const auto& mesh : made.meshes) {
      const auto known = std::find(scene_.meshes.begin(), scene_.meshes.end(), mesh);
      index.push_back(static_cast<std::uint32_t>(known - scene_.meshes.begin()));
      if (known == scene_.meshes.end()) scene_.meshes.push_back(mesh);
    }
    for (Body body : made.bodies) {
      body.mesh = index[body.mesh];
      scene_.bodies.push_back(body);
    }
    if (!has_domain_) scene_.domain = made.domain;
    has_domain_ = true;
    if (!has_gravity_) scene_.gravity_m_s2 = made.gravity_m_s2;
    if (!has_face_material_) scene_.face_material = made.face_material;
    if (!has_theta_) scene_.parameters.theta_m = made.parameters.theta_m;
  }

  void place(const Start& start, const Body& prototype) {
    for (std::size_t n = 0; n < start.positions.size(); ++n) {
      Body body = prototype;
      body.position = start.positions[n];
      body.velocity = start.velocities[n];
      scene_.bodies.push_back(body);
    }
    if (!has_domain_) scene_.domain = start.domain;
    has_domain_ = true;
  }

  // check_scene says "NAME: body 3"; this puts the line of that body in front.
  Result<Scene> checked() {
    const core::Status status = core::check_scene(scene_);
    if (status) return std::move(scene_);
    core::Error error = status.error();
    const std::string prefix = scene_.name + ": ";
    const std::string place = error.where.starts_with(prefix) ? error.where.substr(prefix.size()) : error.where;
    const auto line = lines_.find(place);
    error.where = errors_.file + ":" + (line == lines_.end() ? "1" : std::to_string(line->second)) + ": " + place;
    return error;
  }

  std::filesystem::path path_;
  const SceneOptions& options_;
  FileErrors errors_;
  Scene scene_;
  Material material_;
  bool has_domain_ = false;
  bool has_gravity_ = false;
  bool has_face_material_ = false;
  bool has_theta_ = false;
  std::map<std::string, std::uint32_t> lines_;
  std::map<std::size_t, core::MassProperties> given_mass_;  // by body
};

}  // namespace

Result<Scene> read_scene_file(const std::filesystem::path& path, const SceneOptions& options) {
  const Result<Node> root = parse_toml(path);
  if (!root) return root.error();
  return SceneFileReader(path, options).read(root.value());
}

}  // namespace broadside::datasets
