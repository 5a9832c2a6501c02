// Chooses in how many parts a step of turning bodies is taken on the GPU, and the solver's numbers for each part. The
// same choice as the twin's.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/method/rigid/soft_settings.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "core/scene/pace.hpp"
#include "gpu/rigid/rigid_view.hpp"

namespace broadside::gpu {

// The device finds how fast a step begins only while it takes the first part. So the first part is taken with the plan
// of the step before, and taken again where that plan is wrong.
class PartsChoice {
 public:
  PartsChoice() = default;
  PartsChoice(const core::SoftSettings& solver, const core::Scene& scene, bool are_swept)
      : solver_(solver),
        mass_ratio_(core::largest_mass_ratio(scene)),
        are_swept_(are_swept),
        plan_(core::plan_of_step(solver, mass_ratio_, false, 0.0F, are_swept)) {}

  [[nodiscard]] std::uint32_t count() const { return plan_.parts; }

  // Sets the numbers of one part. view.gravity_m_s2 and view.solver must be set already.
  void fill(RigidFrameView& view, float step_s, bool is_first) const {
    view.step_s = step_s;
    view.dt_s = step_s / static_cast<float>(plan_.parts);
    for (const core::SolveKind kind : core::kSolveKinds) {
      const auto k = static_cast<std::size_t>(kind);
      const core::SolveNumbers numbers = core::solve_numbers(view.solver, kind, plan_);
      view.substeps[k] = numbers.substeps;
      view.soft[k] = core::soft_step_of(view.solver, view.gravity_m_s2, view.dt_s, numbers);
    }
    const float calm_m_s = core::calm_speed_m_s(view.gravity_m_s2, step_s);
    // A step in several parts counts as lively, whatever its later parts begin with.
    view.calm_m_s = plan_.parts > 1 ? -1.0F : calm_m_s;
    view.planned = is_first ? planned(calm_m_s) : PlannedPace{};
  }

  // Plans the step again, from what its first part reported. Returns whether the plan has changed.
  bool replan(const RigidCounts& told, const RigidFrameView& view) {
    const core::Pace pace{from_word(told.fastest_m_s), from_word(told.stride)};
    const core::StepPlan before = plan_;
    plan_ = core::plan_of_step(solver_, mass_ratio_, core::is_calm(pace, view.gravity_m_s2, view.step_s), pace.stride,
                               are_swept_);
    return !(plan_ == before);
  }

 private:
  static float from_word(std::uint32_t word) {
    const auto v = std::bit_cast<float>(word);
    return std::isfinite(v) ? v : std::numeric_limits<float>::infinity();
  }

  [[nodiscard]] PlannedPace planned(float calm_m_s) const {
    PlannedPace right{std::bit_cast<std::uint32_t>(calm_m_s)};
    if (plan_.is_uneven && plan_.is_calm) {
      right.most = 0;
      return right;
    }
    if (plan_.is_uneven) right.least = 1;
    if (plan_.is_uneven && !are_swept_) return right;
    const core::PartsByStride& rule = core::parts_rule(solver_, are_swept_);
    const auto longest = [&](std::uint32_t parts) {
      return std::bit_cast<std::uint32_t>(rule.stride * static_cast<float>(parts));
    };
    const std::uint32_t usual = plan_.is_uneven ? core::uneven_step(solver_, false).parts : 1U;
    if (plan_.parts > usual) right.least = longest(plan_.parts / 2) + 1;
    if (plan_.parts < rule.most) right.most = longest(plan_.parts);
    return right;
  }

  core::SoftSettings solver_;
  float mass_ratio_ = 1.0F;
  bool are_swept_ = false;
  core::StepPlan plan_;
};

}  // namespace broadside::gpu
