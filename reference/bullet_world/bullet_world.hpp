// Bullet's dynamics world behind our interface, and the facts of it that its equivalence card needs.
#pragma once

#include <memory>

#include "core/engine/dynamics.hpp"
#include "core/scene/scene.hpp"
#include "reference/bullet_world/bullet_shapes.hpp"

namespace broadside::reference {

// How Bullet computes the torque that turns w about L; the names are those of btRigidBodyFlags.
enum class BulletGyroscopic { kImplicitBody, kImplicitWorld, kExplicit, kOff };

struct BulletWorldOptions {
  BulletShapeOptions shapes;
  bool uses_scene_rules = true;  // for friction and restitution of two surfaces; otherwise Bullet's products
  bool always_rotates = false;   // otherwise only where a body of the scene has angular velocity
  bool warm_starting = true;     // otherwise Bullet does not keep its impulses, and no points are recorded
  int iterations = 10;
  bool has_two_frictions = false;  // two directions of friction a point; otherwise one, along the slip, as Bullet ships
  BulletGyroscopic gyroscopic = BulletGyroscopic::kImplicitBody;  // as Bullet ships
};

// Records states, boxes and pairs of its broad phase at detection (the start of the step), and contacts as
// contact_readout describes them. Where the scene's motion is rigid, bodies have its inertia and center of mass.
std::unique_ptr<core::Dynamics> make_bullet_world(const BulletWorldOptions& options);

bool bullet_world_rotates(const core::Scene& scene, const BulletWorldOptions& options);

}  // namespace broadside::reference
