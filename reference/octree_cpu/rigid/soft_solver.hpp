// Contact by small substeps with soft constraints and relaxation: core/method/rigid/soft_contact.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/step_constraints.hpp"

namespace broadside::reference {

class SoftSolver final : public ContactSolver {
 public:
  explicit SoftSolver(const core::SoftSettings& settings) : settings_(settings) {}

  void advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
               const RigidStep& step) override;
  [[nodiscard]] std::span<const PatchImpulses> impulses() const override { return work_.impulses(); }
  void forget() override { work_.forget(); }
  [[nodiscard]] SolverSweeps sweeps_done() const override { return {sweeps_done_, work_.bounce_sweeps()}; }

 private:
  void substep(const RigidStep& step, const core::SoftStep& numbers);
  void sweep_until_done(const core::SoftStep& numbers);
  void follow_direction();
  [[nodiscard]] float largest_of_patches() const;

  core::SoftSettings settings_;
  StepConstraints work_;
  std::uint64_t sweeps_done_ = 0;
  std::vector<core::PatchWay> ways_;
  float first_change_ = 0.0F;      // squared, of the first sweep of the substep
  float last_change_ = 0.0F;       // and of the sweep before
  std::vector<float> of_patches_;  // what a loop over patches found
};

}  // namespace broadside::reference
