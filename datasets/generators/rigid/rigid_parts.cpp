#include "datasets/generators/rigid/rigid_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/generators/scene_options.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/cylinder_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::datasets {
namespace {

core::Body& add_body(core::Scene& scene, core::Result<core::Mesh> mesh, core::Vec3 position, double mass_kg) {
  // Sizes are literals of this folder, so an invalid one ends the program in value(). Equal meshes are shared.
  auto made = std::make_shared<const core::Mesh>(std::move(mesh).value());
  const auto known = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                  [&](const auto& m) { return m->vertices == made->vertices; });
  core::Body body;
  body.mesh = static_cast<std::uint32_t>(known - scene.meshes.begin());
  if (known == scene.meshes.end()) scene.meshes.push_back(std::move(made));
  body.position = position;
  body.inverse_mass = mass_kg > 0.0 ? static_cast<float>(1.0 / mass_kg) : 0.0F;
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

core::Vec3 rounded(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

}  // namespace

core::Scene rigid_scene(std::string answer, double dt_s, double seconds) {
  core::Scene scene;
  scene.motion = core::Motion::kRigid;
  scene.answer = std::move(answer);
  scene.gravity_m_s2 = kGravity;
  scene.domain = {{-50.0F, 0.0F, -50.0F}, {50.0F, 50.0F, 50.0F}};
  scene.dt_s = static_cast<float>(dt_s);
  scene.frames = static_cast<std::uint32_t>(std::lround(seconds / dt_s));
  return scene;
}

void set_surfaces(core::Scene& scene, double friction, double restitution) {
  const auto mu = static_cast<float>(friction);
  scene.face_material = {mu, mu, static_cast<float>(restitution)};
  for (core::Body& b : scene.bodies) b.material = scene.face_material;
}

core::Body& add_box(core::Scene& scene, std::array<double, 3> sides_m, core::Vec3 position, double mass_kg) {
  return add_body(scene, box_mesh(sides_m, {1, 1, 1}), position, mass_kg);
}

core::Body& add_ball(core::Scene& scene, double radius_m, core::Vec3 position, double mass_kg) {
  return add_body(scene, sphere_mesh(radius_m, 8), position, mass_kg);
}

core::Body& add_cylinder(core::Scene& scene, double radius_m, double half_length_m, core::Vec3 position,
                         double mass_kg) {
  return add_body(scene, cylinder_mesh(radius_m, half_length_m, 64), position, mass_kg);
}

core::Body& add_prism(core::Scene& scene, const std::vector<std::array<double, 2>>& corners_m, double depth_m,
                      double mass_kg) {
  std::array<double, 2> low = corners_m[0];
  std::array<double, 2> high = low;
  for (const auto& c : corners_m)
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
  // The middle is rounded first, so that the corners get the requested coordinates.
  const core::Vec3 middle = rounded(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.0);
  core::Mesh mesh;
  mesh.name = "prism";
  mesh.source = "procedural: prism of " + std::to_string(corners_m.size()) + " sides";
  const auto n = static_cast<std::uint32_t>(corners_m.size());
  for (const double z : {-0.5 * depth_m, 0.5 * depth_m})
    for (const auto& c : corners_m) mesh.vertices.push_back(rounded(c[0] - middle.x, c[1] - middle.y, z));
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.triangles.push_back({k, next, n + next});
    mesh.triangles.push_back({k, n + next, n + k});
    if (k >= 1 && k + 1 < n) {
      mesh.triangles.push_back({0, k + 1, k});
      mesh.triangles.push_back({n, n + k, n + k + 1});
    }
  }
  return add_body(scene, std::move(mesh), middle, mass_kg);
}

core::Quat about_z(double cosine, bool is_negative) {
  const auto c = static_cast<float>(std::sqrt(0.5 * (1.0 + cosine)));
  const auto s = static_cast<float>(std::sqrt(std::max(0.0, 0.5 * (1.0 - cosine))));
  return {c, 0.0F, 0.0F, is_negative ? -s : s};
}

Slope slope_of(double tangent) {
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  return {rounded(tangent * cosine, cosine, 0.0), about_z(cosine, true)};
}

void add_slope(core::Scene& scene, const Slope& slope) {
  constexpr double kThick_m = 2.0;
  add_box(scene, {40.0, kThick_m, 20.0}, static_cast<float>(-0.5 * kThick_m) * slope.normal, kStaticMass).orientation =
      slope.orientation;
  scene.domain.min.y = -50.0F;
}

}  // namespace broadside::datasets
