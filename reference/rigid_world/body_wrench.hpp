// The scene's wrenches on one body in the form that libraries read: a force and a torque in the world, constant for a
// step.
#pragma once

#include <cstdint>

#include "core/scene/scene.hpp"
#include "reference/plain_rigid/linear.hpp"

namespace broadside::reference {

// Sums over the wrenches on a body. Forces act at its center of mass.
struct BodyWrench {
  plain::Vec force_world;   // N, constant in the world
  plain::Vec force_body;    // N, constant in the body's axes
  plain::Vec torque_world;  // N m
  plain::Vec torque_body;   // N m

  // In the world, for a body of this orientation.
  [[nodiscard]] plain::Vec force(plain::Quaternion q) const { return force_world + plain::matrix(q) * force_body; }
  [[nodiscard]] plain::Vec torque(plain::Quaternion q) const { return torque_world + plain::matrix(q) * torque_body; }
  [[nodiscard]] bool is_none() const;
};

BodyWrench wrench_on(const core::Scene& scene, std::uint32_t body);

}  // namespace broadside::reference
