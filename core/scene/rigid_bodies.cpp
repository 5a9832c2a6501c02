#include "core/scene/rigid_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "core/scene/mass_properties.hpp"
#include "core/scene/surface_octree.hpp"

namespace broadside::core {
namespace {

using Triple = std::array<double, 3>;
using Inertia = std::array<double, 6>;  // xx yy zz xy xz yz

Triple times(const Inertia& m, const Triple& v) {
  return {m[0] * v[0] + m[3] * v[1] + m[4] * v[2], m[3] * v[0] + m[1] * v[1] + m[5] * v[2],
          m[4] * v[0] + m[5] * v[1] + m[2] * v[2]};
}

// The inverse of a positive definite matrix, by cofactors, in double.
Inertia inverse(const Inertia& m) {
  const double a = m[1] * m[2] - m[5] * m[5];
  const double b = m[4] * m[5] - m[3] * m[2];
  const double c = m[3] * m[5] - m[4] * m[1];
  const double determinant = m[0] * a + m[3] * b + m[4] * c;
  return {a / determinant,
          (m[0] * m[2] - m[4] * m[4]) / determinant,
          (m[0] * m[1] - m[3] * m[3]) / determinant,
          b / determinant,
          c / determinant,
          (m[3] * m[4] - m[0] * m[5]) / determinant};
}

// v rotated by the unit quaternion, in double; sign -1 applies the inverse rotation.
Triple turned(Quat q, double sign, const Triple& v) {
  const double size = std::sqrt(double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z);
  const double w = q.w / size;
  const Triple u{sign * q.x / size, sign * q.y / size, sign * q.z / size};
  const auto cross = [](const Triple& a, const Triple& b) {
    return Triple{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Triple s = cross(u, v);
  const Triple t = cross(u, s);
  return {v[0] + 2.0 * (w * s[0] + t[0]), v[1] + 2.0 * (w * s[1] + t[1]), v[2] + 2.0 * (w * s[2] + t[2])};
}

Triple wide(Vec3 v) {
  return {v.x, v.y, v.z};
}
Vec3 narrow(const Triple& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

RigidMass mass_of(const Body& body, const MassProperties& given) {
  RigidMass mass;
  mass.inverse_mass = body.inverse_mass;
  mass.center_of_mass = narrow(given.center_of_mass_m);
  const Inertia i = inverse(given.inertia_kg_m2);
  mass.inverse_inertia = {static_cast<float>(i[0]), static_cast<float>(i[1]), static_cast<float>(i[2]),
                          static_cast<float>(i[3]), static_cast<float>(i[4]), static_cast<float>(i[5])};
  return mass;
}

RigidState start_of(const Body& body, const MassProperties& given) {
  RigidState s;
  s.q = body.orientation;
  s.v = body.velocity;
  const Triple arm = turned(s.q, 1.0, given.center_of_mass_m);
  s.x = narrow({body.position.x + arm[0], body.position.y + arm[1], body.position.z + arm[2]});
  const Triple spin = turned(s.q, -1.0, wide(body.angular_velocity));
  s.angular_momentum = narrow(turned(s.q, 1.0, times(given.inertia_kg_m2, spin)));
  return s;
}

bool has_vertices(const ContactShape& shape) {
  return shape.kind == ContactKind::kHull || shape.kind == ContactKind::kMesh;
}

// The box of the shape, about the center of mass.
Box box_of(const ContactShape& shape, const VertexTreeView& vertices) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = shape.center[k] - shape_support(shape, vertices, axis_vector(k, -1.0F));
    box.max[k] = shape.center[k] + shape_support(shape, vertices, axis_vector(k, 1.0F));
  }
  return box;
}

// The distance of the center of mass from the nearest face.
float inner_ball_of_hull_m(const HullView& hull, Vec3 center) {
  double inner = std::numeric_limits<double>::infinity();
  for (const HullFace& face : std::span(hull.faces, hull.face_count)) {
    const double along = static_cast<double>(face.normal.x) * center.x + static_cast<double>(face.normal.y) * center.y +
                         static_cast<double>(face.normal.z) * center.z;
    inner = std::min(inner, face.offset_m + along);
  }
  return std::max(0.0F, std::nextafterf(static_cast<float>(inner), 0.0F));
}

// The radius of a ball about the center of mass that lies inside the shape, where a closed form or the faces give one;
// otherwise 0.
float inner_ball_m(const ContactShape& s) {
  if (s.kind == ContactKind::kHull) return inner_ball_of_hull_m(s.hull, s.center);
  const float off = length(s.center);
  float inner = 0.0F;
  if (s.kind == ContactKind::kBox) inner = std::min({s.half.x, s.half.y, s.half.z});
  if (s.kind == ContactKind::kSphere || s.kind == ContactKind::kCapsule) inner = s.radius_m;
  if (s.kind == ContactKind::kCylinder) inner = std::min(s.radius_m, s.half_length_m);
  return std::max(0.0F, inner - off);
}

float half_thickness_m(const RigidShape& shape) {
  constexpr float kOfMeshes = 0.25F;
  if (shape.balls.inner_m > 0.0F) return shape.balls.inner_m;
  const Box box = turned_box(shape.contact, shape.vertices(), {}, {});
  float side = box.max[0] - box.min[0];
  for (int k = 1; k < 3; ++k) side = std::min(side, box.max[k] - box.min[k]);
  return kOfMeshes * 0.5F * side;
}

RigidShape shape_of(const ContactShape& contact, const Mesh& mesh) {
  RigidShape shape;
  shape.contact = contact;
  if (has_vertices(contact)) shape.octree = build_body_octree(mesh.vertices);
  // For a convex body, the exact test costs no more than tests of its parts.
  shape.nodes = contact.kind == ContactKind::kMesh ? surface_node_boxes(mesh, Vec3{} - contact.center)
                                                   : single_node_boxes(box_of(contact, shape.vertices()));
  shape.balls.outer_m = length(contact.center) + contact.size_m;
  shape.balls.inner_m = inner_ball_m(contact);
  shape.half_thickness_m = half_thickness_m(shape);
  return shape;
}

void add_wrenches(const Scene& scene, RigidBodies& bodies) {
  if (scene.wrenches.empty()) return;
  bodies.wrench.resize(scene.bodies.size());
  for (const Wrench& w : scene.wrenches) {
    RigidWrench& sum = bodies.wrench[w.body];
    const bool turns = w.axes == WrenchAxes::kBody;
    Vec3& force = turns ? sum.force_body_n : sum.force_world_n;
    Vec3& torque = turns ? sum.torque_body_n_m : sum.torque_world_n_m;
    force = force + w.force_n;
    torque = torque + w.torque_n_m;
  }
}

}  // namespace

Result<RigidBodies> make_rigid_bodies(const Scene& scene) {
  const auto mass = all_mass_properties(scene);
  if (!mass) return mass.error();
  auto shapes = build_contact_shapes(scene, mass.value());
  if (!shapes) return shapes.error();
  RigidBodies bodies;
  bodies.contact_shapes = std::move(shapes).value();
  bodies.shape = bodies.contact_shapes.shape_of_body;
  for (std::size_t k = 0; k < bodies.contact_shapes.shapes.size(); ++k)
    bodies.shapes.push_back(
        shape_of(bodies.contact_shapes.shapes[k], *scene.meshes[bodies.contact_shapes.mesh_of_shape[k]]));
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    const Body& body = scene.bodies[i];
    const bool is_static = !(body.inverse_mass > 0.0F);
    RigidState state;
    state.x = body.position;
    state.q = body.orientation;
    bodies.state.push_back(is_static ? state : start_of(body, mass.value()[i]));
    bodies.mass.push_back(is_static ? RigidMass{} : mass_of(body, mass.value()[i]));
    bodies.material.push_back(body.material);
    bodies.is_static.push_back(is_static ? 1 : 0);
    bodies.static_spin.push_back(is_static ? body.angular_velocity : Vec3{});
  }
  add_wrenches(scene, bodies);
  bodies.detected = bodies.state;
  bodies.free_end.resize(bodies.state.size());
  bodies.push.resize(bodies.state.size());
  bodies.passed_on.resize(bodies.state.size());
  bodies.drift.resize(bodies.state.size());
  bodies.swing_m.resize(bodies.state.size());
  bodies.pushed.resize(bodies.state.size());
  bodies.pushed_by.resize(bodies.state.size());
  bodies.reach_m.resize(bodies.state.size());
  bodies.fall_m.resize(bodies.state.size());
  bodies.shape_boxes.resize(bodies.state.size());
  bodies.boxes.resize(bodies.state.size());
  return bodies;
}

}  // namespace broadside::core
