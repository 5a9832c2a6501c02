#include "reference/rigid_world/rigid_start.hpp"

#include <string>

#include "core/scene/refuse_springs.hpp"

namespace broadside::reference {
namespace {

using plain::Vec;

Vec wide(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

core::Result<RigidStart> start_of(const core::Scene& scene, std::uint32_t index) {
  const core::Body& given = scene.bodies[index];
  RigidStart b;
  b.is_static = !(given.inverse_mass > 0.0F);
  b.mesh = given.mesh;
  b.mass_kg = b.is_static ? 0.0 : 1.0 / static_cast<double>(given.inverse_mass);
  b.material = given.material;
  const core::Quat q = given.orientation;
  b.state = {wide(given.position), plain::normalized({q.w, q.x, q.y, q.z}), wide(given.velocity),
             wide(given.angular_velocity)};
  if (scene.motion == core::Motion::kTranslate && !(given.angular_velocity == core::Vec3{}))
    return core::Error{"the scene's bodies translate, and this one has an angular velocity",
                       scene.name + ": body " + std::to_string(index), "give the scene motion = \"rigid\"",
                       core::Exit::kMissing};
  if (!b.is_static) b.wrench = wrench_on(scene, index);
  if (b.is_static || scene.motion == core::Motion::kTranslate) return b;
  const auto mass = core::mass_properties_of(scene, index);
  if (!mass) return mass.error();
  const auto& c = mass.value().center_of_mass_m;
  const auto& i = mass.value().inertia_kg_m2;
  b.center_of_mass = {c[0], c[1], c[2]};
  b.inertia = {{Vec{i[0], i[3], i[4]}, Vec{i[3], i[1], i[5]}, Vec{i[4], i[5], i[2]}}};
  b.state.x = b.state.x + plain::matrix(b.state.q) * b.center_of_mass;
  return b;
}

}  // namespace

core::Result<std::vector<RigidStart>> rigid_starts(const core::Scene& scene) {
  if (core::Status s = core::refuse_springs(scene); !s) return s.error();
  std::vector<RigidStart> starts;
  starts.reserve(scene.bodies.size());
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    auto start = start_of(scene, i);
    if (!start) return start.error();
    starts.push_back(start.value());
  }
  return starts;
}

}  // namespace broadside::reference
