#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "core/whole_file.hpp"
#include "datasets/mesh/write_ply.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;
using core::Vec3;

// Nine significant digits identify every float and 17 every double exactly. A decimal point keeps -0 from becoming the
// integer 0.
std::string digits(double value, int significant) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.*g", significant, value);
  std::string text = buffer;
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string number(float value) {
  return digits(value, 9);
}
std::string vec3(Vec3 v) {
  return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    char escaped[8];
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      std::snprintf(escaped, sizeof escaped, "\\u%04X", static_cast<unsigned>(static_cast<unsigned char>(c))),
          out += escaped;
    else
      out += c;
  }
  return out + "\"";
}

std::string material(const core::Material& m) {
  return "mu_static = " + number(m.mu_static) + "\nmu_kinetic = " + number(m.mu_kinetic) +
         "\nrestitution = " + number(m.restitution) + "\n";
}

std::string parameters(const core::Parameters& p) {
  return "delta_m = " + number(p.delta_m) + "\nbeta = " + number(p.beta) + "\nalpha = " + number(p.alpha) +
         "\nv_threshold_m_s = " + number(p.v_threshold_m_s) + "\nimpulse_min_n_s = " + number(p.impulse_min_n_s) +
         "\nv_max_m_s = " + number(p.v_max_m_s) + "\nepsilon_m = " + number(p.epsilon_m) +
         "\ntheta_m = " + number(p.theta_m) + "\nhash_cell_m = " + number(p.hash_cell_m) + "\n";
}

// In a scene, names need not be unique; in a file, bodies refer to them, so they must be.
std::string mesh_name(std::size_t m) {
  return "mesh" + std::to_string(m);
}

std::string list(std::span<const double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "[" : ", ") + digits(v, 17);
  return text + "]";
}

std::string mass(const core::MassProperties& m) {
  return "center_of_mass_m = " + list(m.center_of_mass_m) + "\ninertia_kg_m2 = " + list(m.inertia_kg_m2) + "\n";
}

std::string body(const core::Body& b, const core::MassProperties* m, bool is_fast, const core::Material& common) {
  std::string text = "\n[[body]]\nmesh = " + quoted(mesh_name(b.mesh)) + "\nposition_m = " + vec3(b.position) + "\n";
  if (!(b.orientation == core::Quat{}))
    text += "orientation_wxyz = [" + number(b.orientation.w) + ", " + number(b.orientation.x) + ", " +
            number(b.orientation.y) + ", " + number(b.orientation.z) + "]\n";
  text += "velocity_m_s = " + vec3(b.velocity) + "\n";
  text += "angular_velocity_rad_s = " + vec3(b.angular_velocity) + "\n";
  // 1 / w is off by a relative 2^-53, so its inverse rounds back to the float w.
  text += b.inverse_mass > 0.0F ? "mass_kg = " + digits(1.0 / double{b.inverse_mass}, 17) + "\n" : "static = true\n";
  if (m != nullptr && b.inverse_mass > 0.0F) text += mass(*m);
  if (is_fast) text += "fast = true\n";
  if (!(b.material == common)) text += "[body.material]\n" + material(b.material);
  return text;
}

std::string whole_scene(const Scene& scene, const std::string& stem) {
  const bool is_large = scene.seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const std::string seed = std::to_string(scene.seed);
  std::string text =
      "name = " + quoted(scene.name) + "\ndescription = " + quoted(scene.description) +
      "\nframes = " + std::to_string(scene.frames) + "\nseed = " + (is_large ? quoted(seed) : seed) +
      "\ndt_s = " + number(scene.dt_s) + (scene.motion == core::Motion::kTranslate ? "" : "\nmotion = \"rigid\"") +
      (scene.answer.empty() ? "" : "\nanswer = " + quoted(scene.answer)) +
      "\ngravity_m_s2 = " + vec3(scene.gravity_m_s2) + "\n\n[domain]\nmin_m = " + vec3(scene.domain.min) +
      "\nmax_m = " + vec3(scene.domain.max) + "\n\n[parameters]\n" + parameters(scene.parameters) +
      "\n[face_material]\n" + material(scene.face_material);
  const core::Material common = scene.bodies.empty() ? core::Material{} : scene.bodies[0].material;
  text += "\n[material]\n" + material(common);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    text +=
        "\n[[mesh]]\nname = " + quoted(mesh_name(m)) + "\nfile = " + quoted(stem + "." + mesh_name(m) + ".ply") + "\n";
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    text += body(scene.bodies[i], scene.mass_properties.empty() ? nullptr : &scene.mass_properties[i],
                 !scene.is_fast.empty() && scene.is_fast[i] != 0, common);
  for (const core::Spring& s : scene.springs)
    text += "\n[[spring]]\nbody = " + std::to_string(s.body) + "\nanchor_m = " + vec3(s.anchor) +
            "\nstiffness_n_m = " + number(s.stiffness_n_m) + "\ndamping_n_s_m = " + number(s.damping_n_s_m) + "\n";
  for (const core::Wrench& w : scene.wrenches)
    text += "\n[[wrench]]\nbody = " + std::to_string(w.body) +
            (w.axes == core::WrenchAxes::kBody ? "\naxes = \"body\"" : "") + "\nforce_n = " + vec3(w.force_n) +
            "\ntorque_n_m = " + vec3(w.torque_n_m) + "\n";
  return text;
}

}  // namespace

core::Status write_scene_file(const Scene& scene, const std::filesystem::path& path) {
  if (core::Status s = core::check_scene(scene); !s) return s;
  if (path.extension() != ".toml")
    return core::Error{"a scene file's name ends in .toml", path.string(), "add the ending"};
  const std::string stem = path.stem().string();
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    if (core::Status s = write_ply(*scene.meshes[m], path.parent_path() / (stem + "." + mesh_name(m) + ".ply")); !s)
      return s;
  if (core::Status s = core::write_whole_file(path, whole_scene(scene, stem)); !s) return s;

  // Checked by reading it again: loading cleans meshes, so a mesh with degenerate triangles or repeated points would
  // change.
  const core::Result<Scene> again = read_scene_file(path, SceneOptions{.meshes = {}, .frames = {}, .seed = {}});
  if (!again) return again.error();
  if (core::scene_digest(again.value()) != core::scene_digest(scene))
    return core::Error{"the written scene is not the same scene when it is read", path.string(),
                       "clean its meshes first: degenerate triangles, repeated or unreferenced vertices"};
  return core::Done{};
}

}  // namespace broadside::datasets
