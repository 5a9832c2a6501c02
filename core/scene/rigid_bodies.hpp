// The working set of bodies that turn, as it is loaded, and on the CPU as it runs: one entry per body, and what is
// shared by bodies of one shape.
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

// Of a mesh and a center of mass in it.
struct RigidShape {
  ContactShape contact;  // its views point into RigidBodies::contact_shapes
  NodeBoxes nodes;       // from the center of mass, body axes
  BodyOctree octree;     // of the vertices of a hull or mesh, mesh coordinates; else none
  ShapeBalls balls;
  // Of the ball inside. Of a mesh that is not convex, whose inside nobody knows, a quarter of half of its box's
  // shortest side, which is less than most ears and legs.
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
  std::vector<Vec3> static_spin;  // rad/s: what the scene says of static bodies, which never turn
  std::vector<std::uint32_t> shape;
  std::vector<RigidShape> shapes;
  ContactShapes contact_shapes;
  std::vector<std::uint8_t> is_swept;  // by body: 1 = its way is followed; or none: nobody's is (swept_bodies.hpp)
  std::vector<PushWord> push;          // what the candidates of a step tell the next one
  std::vector<PushWord> passed_on;     // and what of that confirmed pairs pass on
  // Of detection: the pose, where it leads to if nothing is touched, by its velocity alone, and where others may drive
  // the body; how far it can come and how far it falls, the box of the shape, and a box that contains all of where it
  // goes.
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
  // Half of the least one.
  [[nodiscard]] float thickness_m(std::uint32_t body) const { return shapes[shape[body]].half_thickness_m; }
  // The same of the thinner of both.
  [[nodiscard]] float thinner_m(Pair pair) const { return std::min(thickness_m(pair.i), thickness_m(pair.j)); }
  [[nodiscard]] bool is_followed(std::uint32_t body) const { return !is_swept.empty() && is_swept[body] != 0; }
  // Whether two bodies are kept from passing through each other.
  [[nodiscard]] bool are_followed(Pair pair) const { return is_followed(pair.i) || is_followed(pair.j); }
  // As another body may feel it.
  [[nodiscard]] Pusher pusher(std::uint32_t body) const {
    return {detected[body].x, drift[body], pushed[body], swing_m[body], mass[body].inverse_mass, body, pushed_by[body]};
  }
  [[nodiscard]] Vec3 spin(std::uint32_t body) const {
    return is_static[body] != 0 ? static_spin[body] : angular_velocity(mass[body], state[body]);
  }
};

// Refuses a mesh that has no inertia or is no shape of a body.
Result<RigidBodies> make_rigid_bodies(const Scene& scene);

}  // namespace broadside::core
