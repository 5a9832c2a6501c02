#include "bench/shrink/case_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string_view>

namespace broadside::bench {
namespace {

using core::Vec3;

std::string number(float v) {
  std::string text = fmt::format("{:.9g}", v);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "F";
}

std::string vec3(Vec3 v) {
  return "{" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "}";
}

std::string literal_of(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  }
  return out + "\"";
}

// "normal-energy" -> "NormalEnergy".
std::string camel(std::string_view name) {
  std::string out;
  bool is_start = true;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      is_start = true;
      continue;
    }
    out += is_start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    is_start = false;
  }
  return out;
}

std::string material(const core::Material& m) {
  return fmt::format("{{{}, {}, {}}}", number(m.mu_static), number(m.mu_kinetic), number(m.restitution));
}

std::string mesh_lines(const core::Mesh& mesh) {
  std::string text = "  {\n    auto mesh = std::make_shared<core::Mesh>();\n    mesh->name = " + literal_of(mesh.name) +
                     ";\n    mesh->source = " + literal_of(mesh.source) + ";\n    mesh->vertices = {";
  for (const Vec3 v : mesh.vertices) text += "\n        " + vec3(v) + ",";
  text += "\n    };\n    mesh->triangles = {";
  for (const core::Triangle& t : mesh.triangles) text += fmt::format("\n        {{{}, {}, {}}},", t[0], t[1], t[2]);
  return text + "\n    };\n    scene.meshes.push_back(mesh);\n  }\n";
}

std::string body_lines(const core::Body& b) {
  std::string text = "  {\n    core::Body body;\n";
  if (b.mesh != 0) text += fmt::format("    body.mesh = {};\n", b.mesh);
  text += "    body.position = " + vec3(b.position) + ";\n";
  if (!(b.orientation == core::Quat{}))
    text += fmt::format("    body.orientation = {{{}, {}, {}, {}}};\n", number(b.orientation.w),
                        number(b.orientation.x), number(b.orientation.y), number(b.orientation.z));
  if (!(b.velocity == Vec3{})) text += "    body.velocity = " + vec3(b.velocity) + ";\n";
  if (!(b.angular_velocity == Vec3{})) text += "    body.angular_velocity = " + vec3(b.angular_velocity) + ";\n";
  if (b.inverse_mass != 1.0F) text += "    body.inverse_mass = " + number(b.inverse_mass) + ";\n";
  if (!(b.material == core::Material{})) text += "    body.material = " + material(b.material) + ";\n";
  return text + "    scene.bodies.push_back(body);\n  }\n";
}

std::string spring_lines(const std::vector<core::Spring>& springs) {
  if (springs.empty()) return "";
  std::string text = "  scene.springs = {";
  for (const core::Spring& s : springs)
    text += fmt::format("\n      {{{}, {}, {}, {}}},", s.body, vec3(s.anchor), number(s.stiffness_n_m),
                        number(s.damping_n_s_m));
  return text + "\n  };\n";
}

// The lines for bodies that turn: what they need in addition to their states.
std::string rigid_lines(const core::Scene& s) {
  std::string text;
  if (s.motion == core::Motion::kRigid) text += "  scene.motion = core::Motion::kRigid;\n";
  if (!s.answer.empty()) text += "  scene.answer = " + literal_of(s.answer) + ";\n";
  for (const core::MassProperties& m : s.mass_properties)
    text += fmt::format("  scene.mass_properties.push_back({{{{{}}}, {{{}}}}});\n", fmt::join(m.center_of_mass_m, ", "),
                        fmt::join(m.inertia_kg_m2, ", "));
  if (!s.is_fast.empty()) text += fmt::format("  scene.is_fast = {{{}}};\n", fmt::join(s.is_fast, ", "));
  for (const core::Wrench& w : s.wrenches)
    text += fmt::format("  scene.wrenches.push_back({{{}, core::WrenchAxes::{}, {}, {}}});\n", w.body,
                        w.axes == core::WrenchAxes::kBody ? "kBody" : "kWorld", vec3(w.force_n), vec3(w.torque_n_m));
  return text;
}

std::string parameter_lines(const core::Parameters& p) {
  const core::Parameters usual;
  std::string text;
  const auto line = [&text](const char* name, float value, float standard) {
    if (value != standard) text += fmt::format("  scene.parameters.{} = {};\n", name, number(value));
  };
  line("delta_m", p.delta_m, usual.delta_m);
  line("beta", p.beta, usual.beta);
  line("alpha", p.alpha, usual.alpha);
  line("v_threshold_m_s", p.v_threshold_m_s, usual.v_threshold_m_s);
  line("impulse_min_n_s", p.impulse_min_n_s, usual.impulse_min_n_s);
  line("v_max_m_s", p.v_max_m_s, usual.v_max_m_s);
  line("epsilon_m", p.epsilon_m, usual.epsilon_m);
  line("theta_m", p.theta_m, usual.theta_m);
  line("hash_cell_m", p.hash_cell_m, usual.hash_cell_m);
  return text;
}

std::string scene_function(const core::Scene& s) {
  std::string text = "core::Scene shrunk_scene() {\n  core::Scene scene;\n  scene.name = " + literal_of(s.name) + ";\n";
  text += fmt::format("  scene.frames = {};\n", s.frames);
  if (s.dt_s != core::Scene{}.dt_s) text += "  scene.dt_s = " + number(s.dt_s) + ";\n";
  if (!(s.gravity_m_s2 == Vec3{})) text += "  scene.gravity_m_s2 = " + vec3(s.gravity_m_s2) + ";\n";
  if (s.seed != 0) text += fmt::format("  scene.seed = {}U;\n", s.seed);
  text += "  scene.domain = {" + vec3(s.domain.min) + ", " + vec3(s.domain.max) + "};\n";
  if (!(s.face_material == core::Material{})) text += "  scene.face_material = " + material(s.face_material) + ";\n";
  text += parameter_lines(s.parameters);
  for (const auto& mesh : s.meshes) text += mesh_lines(*mesh);
  for (const core::Body& b : s.bodies) text += body_lines(b);
  text += spring_lines(s.springs);
  text += rigid_lines(s);
  return text + "  return scene;\n}\n";
}

}  // namespace

std::string case_text(const core::Scene& scene, const CaseFacts& facts) {
  std::string text = "// " + facts.engine + " against " + facts.validator + ": " + facts.verdict.explanation + "\n";
  std::replace(text.begin(), text.end() - 1, '\n', ' ');
  text += "// Made by: " + facts.command + "\n";
  text +=
      "#include <gtest/gtest.h>\n\n#include <memory>\n\n#include \"bench/shrink/trial.hpp\"\n#include "
      "\"core/scene/scene.hpp\"\n\nnamespace broadside::tests {\nnamespace {\n\n";
  text += scene_function(scene);
  const std::string against = facts.against.empty() ? "" : ", " + literal_of(facts.against);
  // In the reduced scene a sound engine may have nothing to judge, or may rightly refuse it, for example because of too
  // long a step; both show in the test's output.
  text += fmt::format(
      "\nTEST(Shrunk, {}Holds) {{\n  const auto verdict = bench::judge_engine(shrunk_scene(), {}, {}{});\n"
      "  if (!verdict.ok() && verdict.error().exit == core::Exit::kBadInput)\n"
      "    GTEST_SKIP() << \"the engine refuses this scene: \" << verdict.error().line();\n"
      "  ASSERT_TRUE(verdict.ok()) << verdict.error().line();\n"
      "  const core::Outcome outcome = verdict.value().outcome;\n"
      "  EXPECT_TRUE(outcome == core::Outcome::kPass || outcome == core::Outcome::kNotApplicable)\n"
      "      << verdict.value().explanation;\n}}\n\n",
      camel(facts.validator), literal_of(facts.engine), literal_of(facts.validator), against);
  return text + "}  // namespace\n}  // namespace broadside::tests\n";
}

}  // namespace broadside::bench
