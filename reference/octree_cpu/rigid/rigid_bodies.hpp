// The working set of bodies that turn, on the CPU: one entry per body, and what is shared by bodies of one shape.
#pragma once

#include <cstdint>
#include <vector>

#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "core/result.hpp"
#include "core/scene/body_octree.hpp"
#include "core/scene/contact_shapes.hpp"
#include "core/scene/scene.hpp"

namespace broadside::reference {

// Of a mesh and a center of mass in it.
struct RigidShape {
  core::ContactShape contact;  // its views point into RigidBodies::contact_shapes
  core::NodeBoxes nodes;       // from the center of mass, body axes
  core::BodyOctree octree;     // of the vertices of a hull or mesh, mesh coordinates; else none
  core::ShapeBalls balls;

  [[nodiscard]] core::VertexTreeView vertices() const {
    return {octree.boxes.data() + core::kLevelOffset[1], octree.boxes.data() + core::kLevelOffset[2],
            octree.leaf_begin.data(), octree.sorted_vertices.data()};
  }
};

struct RigidBodies {
  std::vector<core::RigidState> state;
  std::vector<core::RigidMass> mass;
  std::vector<core::Material> material;
  std::vector<core::RigidWrench> wrench;  // by body, or none in a scene without wrenches
  std::vector<std::uint8_t> is_static;
  std::vector<core::Vec3> static_spin;  // rad/s: what the scene says of static bodies, which never turn
  std::vector<std::uint32_t> shape;
  std::vector<RigidShape> shapes;
  core::ContactShapes contact_shapes;
  // Of detection: the pose, where it leads to if nothing is touched, how far the body can come and how far it falls,
  // the box of the shape, and a box that contains all of where it goes.
  std::vector<core::RigidState> detected;
  std::vector<core::ContactPose> free_end;
  std::vector<float> reach_m;
  std::vector<float> fall_m;
  std::vector<core::Box> shape_boxes;
  std::vector<core::Box> boxes;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(state.size()); }
  [[nodiscard]] core::ContactPose pose(std::uint32_t body) const { return {detected[body].x, detected[body].q}; }
  [[nodiscard]] core::ContactPath path(std::uint32_t body) const { return {pose(body), free_end[body]}; }
  [[nodiscard]] core::Vec3 origin(std::uint32_t body) const { return core::mesh_origin(mass[body], state[body]); }
  [[nodiscard]] core::RigidWrench wrench_of(std::uint32_t body) const {
    return wrench.empty() ? core::RigidWrench{} : wrench[body];
  }
  [[nodiscard]] core::Vec3 spin(std::uint32_t body) const {
    return is_static[body] != 0 ? static_spin[body] : core::angular_velocity(mass[body], state[body]);
  }
};

// Refuses a mesh that has no inertia or is no shape of a body.
core::Result<RigidBodies> make_rigid_bodies(const core::Scene& scene);

}  // namespace broadside::reference
