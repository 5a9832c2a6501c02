// Contact by small substeps with soft constraints and relaxation: core/method/rigid/soft_contact.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/step_constraints.hpp"

namespace broadside::reference {

// SOLVERS.md (core/method/rigid) has the measurements that the defaults were chosen by.
struct SoftSolverOptions {
  // Of a step; twice as many where bodies that touch have masses further apart than even_masses: what a contact yields
  // grows with the mass on it, and falls with the square of the substep.
  std::uint32_t substeps = 4;
  float even_masses = 64.0F;
  // Of a substep, at most. One sweep is Catto's soft step; more go along conjugate directions.
  std::uint32_t sweeps = 12;
  // A sweep is the last one that changes no point's speed by more than this share of the fastest.
  float done = 0x1p-10F;
  float omega_dt = 6.0F;
  float damping = 1.0F;
  PatchLimits limits{0x1p-12F, 0.0F};
  float fixed_bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

// Catto's soft step, without conjugate directions.
SoftSolverOptions soft_step_options();

class SoftSolver final : public ContactSolver {
 public:
  explicit SoftSolver(const SoftSolverOptions& options) : options_(options) {}

  void advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
               const RigidStep& step) override;
  [[nodiscard]] std::span<const PatchImpulses> impulses() const override { return work_.impulses(); }
  void forget() override { work_.forget(); }
  [[nodiscard]] std::uint64_t sweeps_done() const override { return sweeps_done_; }

 private:
  void substep(const RigidStep& step, const core::SoftStep& numbers);
  void sweep_until_done(const core::SoftStep& numbers);
  void follow_direction();
  [[nodiscard]] float largest_of_patches() const;

  SoftSolverOptions options_;
  StepConstraints work_;
  std::uint64_t sweeps_done_ = 0;
  std::vector<core::PatchWay> ways_;
  float last_change_ = 0.0F;       // squared, of the sweep before
  std::vector<float> of_patches_;  // what a loop over patches found
};

}  // namespace broadside::reference
