// Bodies and patches of one step as a contact solver works on them, with the impulses that the step before left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/method/rigid/solver_body.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/impulse_memory.hpp"
#include "reference/octree_cpu/rigid/in_parallel.hpp"
#include "reference/octree_cpu/rigid/patch_coloring.hpp"

namespace broadside::reference {

class StepConstraints {
 public:
  void begin(std::span<const core::RigidState> states, std::span<const core::ContactPatch> patches,
             const RigidStep& step, float substep_s, const core::PatchLimits& limits);
  // Writes the states, and keeps the impulses of the last substep and of the step.
  void finish(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches);
  void forget() { memory_.forget(); }

  [[nodiscard]] std::span<core::SolverBody> bodies() { return bodies_; }
  [[nodiscard]] std::span<core::PatchConstraint> patches() { return constraints_; }
  [[nodiscard]] std::span<const PatchImpulses> impulses() const { return impulses_; }
  // Whether a patch has restitution.
  [[nodiscard]] bool may_bounce() const { return may_bounce_; }

  // work(index) for every body but the one that stands for the faces.
  template <typename Work>
  void each_body(const Work& work) {
    in_parallel(0, bodies_.size() - 1, work);
  }
  // work(patch, a, b) for every patch, in any order: it reads bodies alone.
  template <typename Work>
  void each_patch(const Work& work) {
    in_parallel(0, constraints_.size(), [&](std::size_t k) {
      core::PatchConstraint& c = constraints_[k];
      work(c, bodies_[c.a], bodies_[c.b]);
    });
  }
  // The same color by color: it may write its moved bodies.
  template <typename Work>
  void each_patch_by_color(const Work& work) {
    const auto begin = coloring_.color_begin();
    for (std::uint32_t color = 0; color < coloring_.color_count(); ++color)
      in_parallel(begin[color], begin[color + 1], [&](std::size_t k) {
        core::PatchConstraint& c = constraints_[k];
        work(c, bodies_[c.a], bodies_[c.b]);
      });
  }
  [[nodiscard]] std::size_t index_of(const core::PatchConstraint& c) const {
    return static_cast<std::size_t>(&c - constraints_.data());
  }

  // Sweeps of bounces since it was made.
  [[nodiscard]] std::uint64_t bounce_sweeps() const { return bounce_sweeps_; }

  // Points that came fast leave with their share of that speed: sweeps until one changes no speed by more than
  // 2^-10 of the fastest approach. They visit patches whose bodies bounce or have just been changed by more than that.
  void bounce(const core::SoftStep& numbers);

 private:
  [[nodiscard]] std::span<const core::ContactPatch> awake_of(std::span<const core::ContactPatch> patches,
                                                             std::span<const std::uint8_t> asleep);
  void recall(const core::ContactPatch& patch, core::PatchConstraint& c) const;
  // The fastest approach of what bounces, whose bodies are stirred.
  float stir_what_bounces(const core::SoftStep& numbers);
  void stir(const core::PatchConstraint& c, std::uint32_t sweep);
  [[nodiscard]] bool is_stirred(const core::PatchConstraint& c) const;
  [[nodiscard]] float largest_of_patches() const;

  // Of patches as given, those of bodies that are awake: all, where nobody sleeps.
  std::vector<core::ContactPatch> awake_patches_;
  std::vector<std::uint32_t> awake_;  // their indices
  // The others: what those gave in the step before, and left for the next one.
  struct AsleepPatch {
    std::uint32_t patch;
    PatchImpulses given;
    std::array<RememberedPoint, core::kManifoldPoints> remembered;
  };
  std::vector<AsleepPatch> asleep_;
  PatchColoring coloring_;
  ImpulseMemory memory_;
  std::vector<core::SolverBody> bodies_;            // the last one stands for every face: it never moves
  std::vector<core::PatchConstraint> constraints_;  // in the order of the coloring
  std::vector<PatchImpulses> impulses_;             // by patch as given
  std::vector<float> of_patches_;                   // what a loop over patches found, for the largest of it
  std::vector<std::uint32_t> stirred_;              // [bodies] the sweep that has to visit the body's patches
  std::uint32_t sweep_ = 0;                         // of all sweeps of bounces in this step
  std::uint64_t bounce_sweeps_ = 0;
  float substep_s_ = 0.0F;
  bool may_bounce_ = false;
};

}  // namespace broadside::reference
