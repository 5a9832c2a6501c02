// One contact application in float64: relative velocities and displacements before and after, recomputed from the
// recorded states alone.
#pragma once

#include <cstdint>
#include <optional>

#include "core/contact.hpp"
#include "core/scene/scene.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {

// Friction and restitution of two surfaces together: geometric mean of the frictions, the larger restitution.
struct SurfacePair {
  double mu_static = 0.0;
  double mu_kinetic = 0.0;
  double restitution = 0.0;
};

// Velocities are A's relative to B's, m/s. along_normal components are with respect to the recorded normal, B to A.
struct Application {
  const core::Contact* contact = nullptr;
  double w_a = 0.0;  // 1/kg
  double w_b = 0.0;  // 1/kg; 0 for a face
  double w_sum = 0.0;
  SurfacePair surface;
  Vec3d normal;
  double approach_before = 0.0;  // v_n of METHOD 6: < 0 approaching
  double approach_after = 0.0;
  Vec3d sliding_before;  // v_t
  Vec3d sliding_after;
  Vec3d moved_a;  // post - pre position, m
  Vec3d moved_b;
  // |v_a| + |v_b| before, and the same after: the magnitudes that rounding errors of velocities are relative to.
  double speeds_before = 0.0;
  double speeds_after = 0.0;

  // Bound of the rounding error of v_n and v_t as the engine computes them from the pre states: a subtraction and a dot
  // product of three terms, 4 operations relative to the speeds.
  [[nodiscard]] double relative_velocity_rounding() const;
  // Bound of the rounding error of one component of the relative velocity after: 8 operations (subtraction, product
  // with 1+e, sum of inverse masses, quotient, product with the inverse mass, product with the direction, the normal
  // addition and friction's addition) relative to the speeds and the change.
  [[nodiscard]] double velocity_after_rounding() const;
};

// The scene's bodies as contacts need them.
class ContactBodies {
 public:
  explicit ContactBodies(const core::Scene& scene) : scene_(&scene) {}

  [[nodiscard]] bool knows(std::uint32_t body) const;
  // 0 for static bodies and faces.
  [[nodiscard]] double inverse_mass(std::uint32_t body) const;
  // Nothing when the contact names unknown bodies or two that cannot move: state-sanity reports those.
  [[nodiscard]] std::optional<Application> application(const core::Contact& contact) const;

 private:
  [[nodiscard]] const core::Material& material(std::uint32_t body) const;
  const core::Scene* scene_;
};

}  // namespace broadside::validation
