// A body of the scene in the form that engines of rigid bodies read: in float64, about its center of mass.
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "reference/plain_rigid/linear.hpp"
#include "reference/rigid_world/body_wrench.hpp"

namespace broadside::reference {

struct RigidState {
  plain::Vec x;         // of the center of mass, m
  plain::Quaternion q;  // unit; world from mesh axes
  plain::Vec v;         // of the center of mass, m/s
  plain::Vec w;         // world, rad/s
};

struct RigidStart {
  bool is_static = false;
  std::uint32_t mesh = 0;
  double mass_kg = 0.0;       // 0 of a static body
  plain::Vec center_of_mass;  // in mesh coordinates, m; zero of static bodies and where the scene's bodies translate
  plain::Mat inertia;         // about the center of mass, mesh axes, kg m^2; of bodies that turn
  core::Material material;
  RigidState state;
  BodyWrench wrench;  // none of a static body
};

// The start of every body. Errors: springs; a mesh without inertia in a scene whose bodies turn; an angular velocity in
// a scene whose bodies translate.
core::Result<std::vector<RigidStart>> rigid_starts(const core::Scene& scene);

}  // namespace broadside::reference
