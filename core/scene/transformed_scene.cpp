#include "core/scene/transformed_scene.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

template <typename Change>
std::vector<std::shared_ptr<const Mesh>> changed_meshes(const Scene& scene, const Change& change) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const auto& mesh : scene.meshes) {
    auto copy = std::make_shared<Mesh>(*mesh);
    change(*copy);
    meshes.push_back(std::move(copy));
  }
  return meshes;
}

void scale_vertices(Mesh& mesh, float factor) {
  for (Vec3& v : mesh.vertices) v = factor * v;
}

}  // namespace

Scene scaled_scene(const Scene& scene, float factor) {
  Scene out = scene;
  out.meshes = changed_meshes(scene, [factor](Mesh& mesh) { scale_vertices(mesh, factor); });
  for (Body& b : out.bodies) b.position = factor * b.position, b.velocity = factor * b.velocity;
  for (Spring& s : out.springs) s.anchor = factor * s.anchor;
  for (Wrench& w : out.wrenches) w.force_n = factor * w.force_n, w.torque_n_m = factor * (factor * w.torque_n_m);
  out.domain = {factor * scene.domain.min, factor * scene.domain.max};
  out.gravity_m_s2 = factor * scene.gravity_m_s2;
  for (MassProperties& m : out.mass_properties) {
    for (double& c : m.center_of_mass_m) c *= factor;
    for (double& i : m.inertia_kg_m2) i *= double{factor} * factor;
  }
  Parameters& p = out.parameters;
  for (float* length :
       {&p.delta_m, &p.v_threshold_m_s, &p.impulse_min_n_s, &p.v_max_m_s, &p.epsilon_m, &p.theta_m, &p.hash_cell_m})
    *length *= factor;
  return out;
}

Scene mirrored_scene(const Scene& scene, int axis) {
  const auto mirror = [axis](Vec3& v) { v[axis] = -v[axis]; };
  Scene out = scene;
  out.meshes = changed_meshes(scene, [&](Mesh& mesh) {
    for (Vec3& v : mesh.vertices) mirror(v);
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  });
  for (Body& b : out.bodies) {
    mirror(b.position), mirror(b.velocity);
    // Rotation axes are axial vectors: they keep the mirrored component and flip the other two.
    for (int k = 0; k < 3; ++k)
      if (k != axis) b.angular_velocity[k] = -b.angular_velocity[k];
    if (axis != 0) b.orientation.x = -b.orientation.x;
    if (axis != 1) b.orientation.y = -b.orientation.y;
    if (axis != 2) b.orientation.z = -b.orientation.z;
  }
  for (Spring& s : out.springs) mirror(s.anchor);
  for (Wrench& w : out.wrenches) {
    mirror(w.force_n);
    for (int k = 0; k < 3; ++k)
      if (k != axis) w.torque_n_m[k] = -w.torque_n_m[k];
  }
  mirror(out.gravity_m_s2);
  for (MassProperties& m : out.mass_properties) {
    m.center_of_mass_m[static_cast<std::size_t>(axis)] *= -1.0;
    // Of xy, xz and yz, the two that involve the mirrored axis change their sign.
    for (int k = 0; k < 3; ++k)
      if (k != 2 - axis) m.inertia_kg_m2[std::size_t{3} + static_cast<std::size_t>(k)] *= -1.0;
  }
  out.domain.min[axis] = -scene.domain.max[axis];
  out.domain.max[axis] = -scene.domain.min[axis];
  return out;
}

Scene turned_scene(const Scene& scene, int axis) {
  const int u = (axis + 1) % 3;
  const int w = (axis + 2) % 3;
  const auto turn = [u, w](Vec3 v) {
    Vec3 out = v;
    out[u] = -v[w];
    out[w] = v[u];
    return out;
  };
  Scene out = scene;
  out.meshes = changed_meshes(scene, [&](Mesh& mesh) {
    for (Vec3& v : mesh.vertices) v = turn(v);
  });
  for (Body& b : out.bodies) {
    b.position = turn(b.position), b.velocity = turn(b.velocity), b.angular_velocity = turn(b.angular_velocity);
    const Vec3 q = turn({b.orientation.x, b.orientation.y, b.orientation.z});
    b.orientation = {b.orientation.w, q.x, q.y, q.z};
  }
  for (Spring& s : out.springs) s.anchor = turn(s.anchor);
  for (Wrench& v : out.wrenches) v.force_n = turn(v.force_n), v.torque_n_m = turn(v.torque_n_m);
  out.gravity_m_s2 = turn(scene.gravity_m_s2);
  const auto slot = [](int i, int j) { return static_cast<std::size_t>(i == j ? i : 2 + i + j); };
  for (std::size_t k = 0; k < scene.mass_properties.size(); ++k) {
    const MassProperties& from = scene.mass_properties[k];
    MassProperties& to = out.mass_properties[k];
    const auto [a, c, d] = std::array<std::size_t, 3>{static_cast<std::size_t>(axis), static_cast<std::size_t>(u),
                                                      static_cast<std::size_t>(w)};
    to.center_of_mass_m[a] = from.center_of_mass_m[a];
    to.center_of_mass_m[c] = -from.center_of_mass_m[d];
    to.center_of_mass_m[d] = from.center_of_mass_m[c];
    std::swap(to.inertia_kg_m2[c], to.inertia_kg_m2[d]);
    to.inertia_kg_m2[slot(u, w)] = -from.inertia_kg_m2[slot(u, w)];
    to.inertia_kg_m2[slot(axis, u)] = -from.inertia_kg_m2[slot(axis, w)];
    to.inertia_kg_m2[slot(axis, w)] = from.inertia_kg_m2[slot(axis, u)];
  }
  const Vec3 p = turn(scene.domain.min);
  const Vec3 q = turn(scene.domain.max);
  for (int k = 0; k < 3; ++k) out.domain.min[k] = std::min(p[k], q[k]), out.domain.max[k] = std::max(p[k], q[k]);
  return out;
}

Scene renumbered_scene(const Scene& scene, std::span<const std::uint32_t> order) {
  Scene out = scene;
  std::vector<std::uint32_t> place(scene.bodies.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    out.bodies[k] = scene.bodies[order[k]];
    place[order[k]] = k;
  }
  for (Spring& s : out.springs) s.body = place[s.body];
  for (Wrench& w : out.wrenches) w.body = place[w.body];
  if (!scene.mass_properties.empty())
    for (std::uint32_t k = 0; k < order.size(); ++k) out.mass_properties[k] = scene.mass_properties[order[k]];
  if (!scene.is_fast.empty())
    for (std::uint32_t k = 0; k < order.size(); ++k) out.is_fast[k] = scene.is_fast[order[k]];
  return out;
}

Scene grown_scene(const Scene& scene, float factor) {
  Scene out = scene;
  out.meshes = changed_meshes(scene, [factor](Mesh& mesh) { scale_vertices(mesh, factor); });
  return out;
}

}  // namespace broadside::core
