#include "reference/plain_rigid/scene_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/scene/primitive.hpp"

namespace broadside::reference::plain {
namespace {

// The most faces of a convex mesh; for more, use another engine.
constexpr std::size_t kMostFaces = 200;

core::Result<RigidBody> shape_of(const core::Scene& scene, std::uint32_t index) {
  const core::Mesh& mesh = *scene.meshes[scene.bodies[index].mesh];
  const auto primitive = core::primitive_of(mesh);
  RigidBody b;
  if (primitive && primitive->kind == core::PrimitiveKind::kSphere) {
    b.radius = primitive->radius_m;
    return b;
  }
  if (primitive && primitive->kind == core::PrimitiveKind::kBox) {
    b.half_extents = vec(primitive->half_extents);
    b.polytope = std::make_shared<const Polytope>(box_polytope(b.half_extents));
    return b;
  }
  const std::string where = scene.name + ": body " + std::to_string(index);
  const std::string advice = "plain-rigid knows boxes, spheres and convex meshes of few faces";
  if (primitive)
    return core::Error{"unsupported: " + std::string(core::primitive_word(primitive->kind)), where, advice,
                       core::Exit::kMissing};
  if (mesh.triangles.size() > 2 * kMostFaces || !core::is_convex(mesh))
    return core::Error{mesh.triangles.size() > 2 * kMostFaces ? "unsupported: a mesh of so many faces"
                                                              : "unsupported: a mesh that is not convex",
                       where, advice, core::Exit::kMissing};
  b.polytope = std::make_shared<const Polytope>(polytope_of(mesh));
  return b;
}

double reach_of(const RigidBody& b) {
  if (b.is_sphere()) return length(b.center_of_mass) + b.radius;
  double reach = 0.0;
  for (const Vec p : b.polytope->vertices) reach = std::max(reach, length(p - b.center_of_mass));
  return reach;
}

}  // namespace

core::Result<RigidBody> body_of(const core::Scene& scene, std::uint32_t index, const core::MassProperties& mass) {
  const core::Body& given = scene.bodies[index];
  auto shape = shape_of(scene, index);
  if (!shape) return shape.error();
  RigidBody b = shape.value();
  b.material = given.material;
  b.inverse_mass = given.inverse_mass;
  b.q = normalized({given.orientation.w, given.orientation.x, given.orientation.y, given.orientation.z});
  b.v = vec(given.velocity);
  b.x = vec(given.position);
  if (b.is_static()) {
    b.inverse_inertia = {{Vec{}, Vec{}, Vec{}}};
    b.static_spin = vec(given.angular_velocity);
    b.reach = reach_of(b);
    return b;
  }
  const auto& i = mass.inertia_kg_m2;
  const auto& c = mass.center_of_mass_m;
  b.inertia = {{Vec{i[0], i[3], i[4]}, Vec{i[3], i[1], i[5]}, Vec{i[4], i[5], i[2]}}};
  b.inverse_inertia = inverse(b.inertia);
  const auto moments = core::principal_moments(i);
  b.slenderness = std::sqrt(moments[2] / moments[0]);
  b.center_of_mass = {c[0], c[1], c[2]};
  b.reach = reach_of(b);
  const Mat r = b.rotation();
  const Vec arm = r * b.center_of_mass;
  const Vec spin = vec(given.angular_velocity);
  b.x = b.x + arm;
  b.angular_momentum = r * (b.inertia * (transposed(r) * spin));
  return b;
}

}  // namespace broadside::reference::plain
