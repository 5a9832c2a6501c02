// Where a frame's change of energy comes from: the work of each stage, from the recorded impulses and depths alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "validation/application.hpp"

namespace broadside::validation {

// J. Of all dynamic bodies; potential: gravity, zero at the origin, and springs, zero at their anchors.
struct EnergyRow {
  std::uint64_t step = 0;
  double kinetic = 0.0;  // at the end of the frame
  double potential = 0.0;
  double change = 0.0;  // of their sum since the frame before
  // Terms whose sum is the change:
  double integration = 0.0;  // the integrator's own error: -m dt^2 |g|^2 / 2 a body and step under gravity alone
  double normal = 0.0;       // J_n (v_n + v_n') / 2
  double friction = 0.0;     // J_t t . (v + v') / 2
  double correction = 0.0;   // lifting and stretching by the position correction
  double clip = 0.0;         // the velocity cap
  // Bound of what rounding may have added or taken: |change - sum| is at most this.
  double rounding = 0.0;
  // Of the float64 sums themselves: how many terms, and the sum of their magnitudes, J.
  double terms = 0.0;
  double summed = 0.0;

  [[nodiscard]] double sum() const { return integration + normal + friction + correction + clip; }
};

// Each term is predicted in float64 from the state before it: the integrator's by P(1) to P(3), a contact's from its
// recorded normal, tangent, impulses and depth (METHOD 5, 6), the cap's by P(23). So the sum is right only when every
// stage did what it recorded and passed its result on.
class EnergyLedger {
 public:
  explicit EnergyLedger(const core::Scene& scene);

  // previous: the frame of the step before, or null for step 1. Nothing when frames do not follow each other or lack
  // states, detection states or contacts.
  [[nodiscard]] std::optional<EnergyRow> row(const core::FrameRecord& frame, const core::FrameRecord* previous) const;

 private:
  [[nodiscard]] double potential(std::uint32_t body, Vec3d x) const;
  [[nodiscard]] double energy(std::uint32_t body, Vec3d x, Vec3d v) const;
  // Bound of the energy's error when x and v are off by this much.
  [[nodiscard]] double error(std::uint32_t body, Vec3d x, Vec3d v, double off_x, double off_v) const;
  static void add(EnergyRow& row, double magnitude);
  [[nodiscard]] double double_rounding(const EnergyRow& row) const;
  void integrate(std::uint32_t body, Vec3d x0, Vec3d v0, EnergyRow& row) const;
  void apply(const Application& app, EnergyRow& row) const;
  void clip(const core::FrameRecord& frame, EnergyRow& row) const;

  const core::Scene& scene_;
  ContactBodies bodies_;
  Vec3d gravity_;
  std::vector<std::vector<core::Spring>> springs_;  // by body; empty when the scene has none
  double most_springs_ = 0.0;                       // on one body
};

}  // namespace broadside::validation
