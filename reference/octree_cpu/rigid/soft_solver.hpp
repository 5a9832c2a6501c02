// Contact by small substeps with soft constraints and relaxation: core/method/rigid/soft_contact.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/soft_settings.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/patch_kernels.hpp"
#include "reference/octree_cpu/rigid/step_constraints.hpp"

namespace broadside::reference {

class SoftSolver final : public ContactSolver {
 public:
  explicit SoftSolver(const core::SoftSettings& settings, const PatchKernels& kernels = patch_kernels())
      : settings_(settings), kernels_(kernels), work_(kernels) {}

  void advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
               const RigidStep& step) override;
  [[nodiscard]] core::StepPlan plan_of_step(float largest_mass_ratio, bool is_calm, float stride,
                                            bool are_swept) const override;
  [[nodiscard]] std::span<const PatchImpulses> impulses() const override { return work_.impulses(); }
  void forget() override { work_.forget(); }
  [[nodiscard]] SolverSweeps sweeps_done() const override { return {sweeps_done_, work_.bounce_sweeps()}; }

 private:
  void substep(const RigidStep& step, const core::SoftStep& numbers, core::SolveKind kind);
  // Returns the change of a point's speed, m/s, at or below which its sweeps end.
  float sweep_until_done(const core::SoftStep& numbers);
  void relax(const core::SoftStep& numbers);
  [[nodiscard]] float largest_speed() const;

  core::SoftSettings settings_;
  const PatchKernels& kernels_;
  StepConstraints work_;
  std::uint64_t sweeps_done_ = 0;
  std::vector<float> pushes_;   // by place: core::fastest_push
  std::vector<float> speeds_;   // by tile: the largest speed, or change of one, that a loop found
  std::vector<float> changes_;  // by place: core::squared_change of the last sweep
  std::vector<float> relaxed_;  // by place: what relaxation changed, m/s
};

}  // namespace broadside::reference
