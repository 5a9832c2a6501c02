// The working data of bodies that turn, as it is loaded and, on the CPU, as it runs: one entry per body, and what
// bodies of one shape share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/pushed_motion.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "core/scene/body_octree.hpp"
#include "core/scene/contact_shapes.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

// The shape of a mesh with a given center of mass.
struct RigidShape {
  ContactShape contact;  // its views point into RigidBodies::contact_shapes
  NodeBoxes nodes;       // from the center of mass, body axes
  BodyOctree octree;     // of the vertices of a hull or mesh, mesh coordinates; else none
  ShapeBalls balls;
  // The radius of the ball inside. Where no such ball is known, as for a mesh that is not convex, it is a quarter of
  // half of its box's shortest side, which is less than most ears and legs.
  float half_thickness_m = 0.0F;

  [[nodiscard]] VertexTreeView vertices() const {
    return {octree.boxes.data() + kLevelOffset[1], octree.boxes.data() + kLevelOffset[2], octree.leaf_begin.data(),
            octree.sorted_vertices.data()};
  }
};

struct RigidBodies {
  std::vector<RigidState> state;
  std::vector<RigidMass> mass;
  std::vector<Material> material;
  std::vector<RigidWrench> wrench;  // by body, or none in a scene without wrenches
  std::vector<std::uint8_t> is_static;
  std::vector<Vec3> static_spin;  // rad/s: the scene's angular velocity of static bodies, which never turn
  std::vector<std::uint32_t> shape;
  std::vector<RigidShape> shapes;
  ContactShapes contact_shapes;
  std::vector<std::uint8_t> is_swept;  // by body: 1 = its path is swept; empty: no path is (swept_bodies.hpp)
  std::vector<PushWord> push;          // the pushes that a step's candidate pairs pass to the next step
  std::vector<PushWord> passed_on;     // and the pushes that confirmed pairs pass on
  // At detection: the pose; where its velocity alone would take it if it touched nothing; where other bodies may push
  // it; how far it can come and how far it falls; the box of the shape; and a box that contains its whole possible
  // path.
  std::vector<RigidState> detected;
  std::vector<ContactPose> free_end;
  std::vector<Vec3> drift;
  std::vector<float> swing_m;
  std::vector<Vec3> pushed;
  std::vector<std::uint32_t> pushed_by;
  std::vector<float> reach_m;
  std::vector<float> fall_m;
  std::vector<Box> shape_boxes;
  std::vector<Box> boxes;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(state.size()); }
  [[nodiscard]] ContactPose pose(std::uint32_t body) const { return {detected[body].x, detected[body].q}; }
  [[nodiscard]] ContactPath path(std::uint32_t body) const { return {pose(body), free_end[body]}; }
  [[nodiscard]] Vec3 origin(std::uint32_t body) const { return mesh_origin(mass[body], state[body]); }
  [[nodiscard]] RigidWrench wrench_of(std::uint32_t body) const {
    return wrench.empty() ? RigidWrench{} : wrench[body];
  }
  // Half of the body's thickness (RigidShape).
  [[nodiscard]] float thickness_m(std::uint32_t body) const { return shapes[shape[body]].half_thickness_m; }
  // The same for the thinner of the two bodies.
  [[nodiscard]] float thinner_m(Pair pair) const { return std::min(thickness_m(pair.i), thickness_m(pair.j)); }
  [[nodiscard]] bool is_followed(std::uint32_t body) const { return !is_swept.empty() && is_swept[body] != 0; }
  // Whether the two bodies are kept from passing through each other.
  [[nodiscard]] bool are_followed(Pair pair) const { return is_followed(pair.i) || is_followed(pair.j); }
  // The body as a possible pusher of another body.
  [[nodiscard]] Pusher pusher(std::uint32_t body) const {
    return {detected[body].x, drift[body], pushed[body], swing_m[body], mass[body].inverse_mass, body, pushed_by[body]};
  }
  [[nodiscard]] Vec3 spin(std::uint32_t body) const {
    return is_static[body] != 0 ? static_spin[body] : angular_velocity(mass[body], state[body]);
  }
};

// Error: a mesh that has no inertia or cannot be the shape of a body.
Result<RigidBodies> make_rigid_bodies(const Scene& scene);

}  // namespace broadside::core
