// Contact by small substeps with soft constraints, relaxation and warm starting: core/method/rigid/soft_contact.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/impulse_memory.hpp"
#include "reference/octree_cpu/rigid/patch_coloring.hpp"

namespace broadside::reference {

struct SoftSolverOptions {
  std::uint32_t substeps = 8;
  std::uint32_t relax_sweeps = 1;
  float omega_dt = 1.2F;  // of the substep
  float damping = 1.0F;
  float slop_m = 0.0F;
  float fastest_push_m_s = 3.0F;
  float bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

class SoftSolver final : public ContactSolver {
 public:
  explicit SoftSolver(SoftSolverOptions options) : options_(options) {}

  void advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
               const RigidStep& step) override;
  [[nodiscard]] std::span<const PatchImpulses> impulses() const override { return impulses_; }
  void forget() override { memory_.forget(); }

 private:
  void begin(std::span<const core::RigidState> states, std::span<const core::ContactPatch> patches,
             const RigidStep& step);
  void recall(const core::ContactPatch& patch, core::PatchConstraint& c) const;
  void substep(const RigidStep& step, const core::SoftStep& numbers);
  void finish(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches);
  [[nodiscard]] core::SoftStep numbers_of(const RigidStep& step) const;

  // The work of every patch, color by color.
  template <typename Work>
  void each_patch(const Work& work);
  template <typename Work>
  void each_body(const Work& work);

  SoftSolverOptions options_;
  PatchColoring coloring_;
  ImpulseMemory memory_;
  std::vector<core::SolverBody> bodies_;            // the last one stands for every face: it never moves
  std::vector<core::PatchConstraint> constraints_;  // in the order of the coloring
  std::vector<PatchImpulses> impulses_;
  float substep_s_ = 0.0F;
  bool has_bouncing_surface_ = false;
};

}  // namespace broadside::reference
