#include "reference/plugin/plugin_scene.hpp"

namespace broadside::reference {
namespace {

void to_c(float (&to)[3], core::Vec3 v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

static_assert(sizeof(core::Vec3) == 3 * sizeof(float) && sizeof(core::Triangle) == 3 * sizeof(std::uint32_t));

}  // namespace

broadside_mesh mesh_to_c(const core::Mesh& mesh) {
  return {.vertices = &mesh.vertices.data()->x,
          .vertex_count = mesh.vertices.size(),
          .triangles = mesh.triangles.data()->data(),
          .triangle_count = mesh.triangles.size()};
}

broadside_state state_to_c(core::Vec3 position, core::Quat orientation, core::Vec3 velocity, core::Vec3 angular) {
  broadside_state state{};
  to_c(state.position, position);
  state.orientation[0] = orientation.w;
  state.orientation[1] = orientation.x;
  state.orientation[2] = orientation.y;
  state.orientation[3] = orientation.z;
  to_c(state.velocity, velocity);
  to_c(state.angular_velocity, angular);
  return state;
}

core::Vec3 vec3_from_c(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

core::Quat quat_from_c(const float (&q)[4]) {
  return {q[0], q[1], q[2], q[3]};
}

PluginScene::PluginScene(const core::Scene& scene) {
  for (const auto& mesh : scene.meshes) meshes_.push_back(mesh_to_c(*mesh));
  for (const core::Body& b : scene.bodies)
    bodies_.push_back({.mesh = b.mesh,
                       .state = state_to_c(b.position, b.orientation, b.velocity, b.angular_velocity),
                       .inverse_mass = b.inverse_mass,
                       .mu_static = b.material.mu_static,
                       .mu_kinetic = b.material.mu_kinetic,
                       .restitution = b.material.restitution});
  scene_.meshes = meshes_.data();
  scene_.mesh_count = static_cast<std::uint32_t>(meshes_.size());
  scene_.bodies = bodies_.data();
  scene_.body_count = static_cast<std::uint32_t>(bodies_.size());
  to_c(scene_.domain_min, scene.domain.min);
  to_c(scene_.domain_max, scene.domain.max);
  scene_.face_mu_static = scene.face_material.mu_static;
  scene_.face_mu_kinetic = scene.face_material.mu_kinetic;
  scene_.face_restitution = scene.face_material.restitution;
  to_c(scene_.gravity, scene.gravity_m_s2);
  scene_.dt = scene.dt_s;
  scene_.delta = scene.parameters.delta_m;
  scene_.theta = scene.parameters.theta_m;
}

}  // namespace broadside::reference
