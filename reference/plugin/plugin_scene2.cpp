#include "reference/plugin/plugin_scene2.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/scene/primitive.hpp"
#include "reference/plugin/plugin_scene.hpp"

namespace broadside::reference {
namespace {

void to_c(double (&to)[3], core::Vec3 v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

// The kinds of core/scene/primitive.hpp by name.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 4> kKinds{{{"box", BROADSIDE_BOX},
                                                                            {"sphere", BROADSIDE_SPHERE},
                                                                            {"capsule", BROADSIDE_CAPSULE},
                                                                            {"cylinder", BROADSIDE_CYLINDER}}};

broadside_shape shape_of(const core::Mesh& mesh) {
  broadside_shape shape{};
  const core::Box box = core::bounds(mesh);
  to_c(shape.half_extents, 0.5F * (box.max - box.min));
  shape.kind = core::is_convex(mesh) ? BROADSIDE_CONVEX : BROADSIDE_MESH;
  const auto primitive = core::primitive_of(mesh);
  if (!primitive) return shape;
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const auto& row) { return row.first == core::primitive_word(primitive->kind); });
  if (kind == kKinds.end()) return shape;
  shape.kind = kind->second;
  to_c(shape.half_extents, primitive->half_extents);
  if (shape.kind == BROADSIDE_BOX) return shape;
  shape.radius = primitive->radius_m;
  if (shape.kind == BROADSIDE_SPHERE) return shape;
  shape.axis = static_cast<std::uint32_t>(primitive->axis);
  const double along = primitive->half_extents[primitive->axis];
  shape.half_length = shape.kind == BROADSIDE_CAPSULE ? along - shape.radius : along;
  return shape;
}

std::vector<broadside_wrench> wrenches_to_c(const core::Scene& scene) {
  std::vector<broadside_wrench> wrenches;
  for (const core::Wrench& w : scene.wrenches) {
    broadside_wrench wrench{};
    wrench.body = w.body;
    wrench.axes = static_cast<std::uint32_t>(w.axes);
    to_c(wrench.force, w.force_n);
    to_c(wrench.torque, w.torque_n_m);
    wrenches.push_back(wrench);
  }
  return wrenches;
}

broadside_body2 body_to_c(const core::Body& b) {
  broadside_body2 body{};
  body.mesh = b.mesh;
  body.is_static = b.inverse_mass > 0.0F ? 0 : 1;
  body.mass = body.is_static == 1 ? 0.0 : 1.0 / static_cast<double>(b.inverse_mass);
  to_c(body.state.position, b.position);
  to_c(body.state.velocity, b.velocity);
  to_c(body.state.angular_velocity, b.angular_velocity);
  const std::array<float, 4> q{b.orientation.w, b.orientation.x, b.orientation.y, b.orientation.z};
  std::copy(q.begin(), q.end(), body.state.orientation);
  body.mu_static = b.material.mu_static;
  body.mu_kinetic = b.material.mu_kinetic;
  body.restitution = b.material.restitution;
  return body;
}

}  // namespace

core::Status PluginScene2::add_bodies(const core::Scene& scene) {
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    bodies_.push_back(body_to_c(scene.bodies[i]));
    if (bodies_.back().is_static == 1) continue;
    const auto mass = core::mass_properties_of(scene, i);
    if (!mass && scene.motion == core::Motion::kRigid) return mass.error();
    if (!mass) continue;
    std::copy(mass.value().center_of_mass_m.begin(), mass.value().center_of_mass_m.end(),
              bodies_.back().center_of_mass);
    std::copy(mass.value().inertia_kg_m2.begin(), mass.value().inertia_kg_m2.end(), bodies_.back().inertia);
  }
  return core::Done{};
}

core::Result<std::unique_ptr<PluginScene2>> PluginScene2::of(const core::Scene& scene) {
  std::unique_ptr<PluginScene2> made(new PluginScene2);
  for (const auto& mesh : scene.meshes) {
    made->meshes_.push_back(mesh_to_c(*mesh));
    made->shapes_.push_back(shape_of(*mesh));
  }
  if (core::Status s = made->add_bodies(scene); !s) return s.error();
  made->wrenches_ = wrenches_to_c(scene);
  broadside_scene2& c = made->scene_;
  c.size = sizeof c;
  c.motion = scene.motion == core::Motion::kRigid ? BROADSIDE_RIGID : BROADSIDE_TRANSLATE;
  c.name = scene.name.c_str();
  c.meshes = made->meshes_.data();
  c.shapes = made->shapes_.data();
  c.bodies = made->bodies_.data();
  c.wrenches = made->wrenches_.data();
  c.mesh_size = sizeof(broadside_mesh);
  c.shape_size = sizeof(broadside_shape);
  c.body_size = sizeof(broadside_body2);
  c.wrench_size = sizeof(broadside_wrench);
  c.mesh_count = static_cast<std::uint32_t>(made->meshes_.size());
  c.body_count = static_cast<std::uint32_t>(made->bodies_.size());
  c.wrench_count = static_cast<std::uint32_t>(made->wrenches_.size());
  c.frames = scene.frames;
  to_c(c.domain_min, scene.domain.min);
  to_c(c.domain_max, scene.domain.max);
  c.face_mu_static = scene.face_material.mu_static;
  c.face_mu_kinetic = scene.face_material.mu_kinetic;
  c.face_restitution = scene.face_material.restitution;
  to_c(c.gravity, scene.gravity_m_s2);
  c.dt = scene.dt_s;
  c.delta = scene.parameters.delta_m;
  c.v_threshold = scene.parameters.v_threshold_m_s;
  c.v_max = scene.parameters.v_max_m_s;
  c.theta = scene.parameters.theta_m;
  c.seed = scene.seed;
  return made;
}

}  // namespace broadside::reference
