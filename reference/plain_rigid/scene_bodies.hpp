// The bodies of a scene in plain-rigid's form.
#pragma once

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "reference/plain_rigid/rigid_body.hpp"

namespace broadside::reference::plain {

inline Vec vec(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

// The body at the scene's start, with its mass properties. For a shape that plain-rigid lacks, an error that says
// "unsupported".
core::Result<RigidBody> body_of(const core::Scene& scene, std::uint32_t index, const core::MassProperties& mass);

}  // namespace broadside::reference::plain
