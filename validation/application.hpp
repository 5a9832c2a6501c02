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
  // The magnitudes that rounding errors are relative to, m/s. Along the normal a component counts by |n_k|, across it
  // by sqrt(1 - n_k^2): METHOD 4's normals are axes, for which these are single components, and any unit normal is
  // covered too.
  double along_before = 0.0;  // sum of |n_k r_k|, r the relative velocity before
  double along_after = 0.0;   // the same of |v_a| and |v_b| after, of bodies that can move
  double along_change = 0.0;  // and of r' - r, its part along and its part across the normal each by magnitude
  double across_after = 0.0;
  double across_change = 0.0;

  // Bounds of rounding errors in float32, m/s; u = 2^-24.
  // v_n from the pre states: a subtraction, a product, two additions: 4 operations on each |n_k r_k|.
  [[nodiscard]] double approach_rounding() const;
  // v_t from them: r, and r - v_n n, 2 operations on |v_t| and 6 on what v_n adds. Its square underflows below sqrt(3 *
  // 2^-149).
  [[nodiscard]] double sliding_rounding() const;
  // Error of the velocities after, along the normal, for given impulses: two additions a body, 3 operations on the
  // change (two products, and one for the rounded sum that the second addition starts from), and the tangent's
  // component along the normal, as far as rounding explains it.
  [[nodiscard]] double approach_after_rounding() const;
  // The same across the normal.
  [[nodiscard]] double sliding_after_rounding() const;

 private:
  [[nodiscard]] double leak() const;
};

// What a contact needs to know of the scene's bodies.
class ContactBodies {
 public:
  explicit ContactBodies(const core::Scene& scene) : scene_(&scene) {}

  [[nodiscard]] bool knows(std::uint32_t body) const;
  // 0 for static bodies and faces.
  [[nodiscard]] double inverse_mass(std::uint32_t body) const;
  // Nothing when A is no body, when B is unknown, or when neither can move: state-sanity reports those.
  [[nodiscard]] std::optional<Application> application(const core::Contact& contact) const;

 private:
  [[nodiscard]] const core::Material& material(std::uint32_t body) const;
  const core::Scene* scene_;
};

}  // namespace broadside::validation
