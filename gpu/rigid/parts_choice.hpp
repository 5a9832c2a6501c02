// In how many parts a step of turning bodies is taken on the GPU, and with which numbers each is solved. As in the
// twin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/method/rigid/soft_settings.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "core/scene/calm_bodies.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

class PartsChoice {
 public:
  PartsChoice() = default;
  PartsChoice(const core::SoftSettings& solver, const core::Scene& scene)
      : solver_(solver), mass_ratio_(core::largest_mass_ratio(scene)) {}

  // before: the states that the step begins with, which are read where the masses ask for it.
  core::Status choose(const core::RigidBodies& bodies, const DeviceBuffer<core::RigidState>& before,
                      const core::Scene& scene, float step_s) {
    if (!core::is_uneven(solver_, mass_ratio_)) return core::Done{};
    std::vector<core::RigidState> states;
    BROADSIDE_TRY(before.download(states, bodies.state.size()));
    is_calm_ = core::are_calm(bodies, states, scene.gravity_m_s2, step_s);
    count_ = core::parts_of_step(solver_, mass_ratio_, is_calm_);
    return core::Done{};
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] bool may_be_many() const { return core::most_parts(solver_, mass_ratio_) > 1; }

  // Of each part. The view has gravity and solver.
  void fill(RigidFrameView& view, float step_s) const {
    view.dt_s = step_s / static_cast<float>(count_);
    for (const core::SolveKind kind : core::kSolveKinds) {
      const auto k = static_cast<std::size_t>(kind);
      const core::SolveNumbers& numbers = core::solve_numbers(view.solver, kind, is_calm_);
      view.substeps[k] = numbers.substeps;
      view.soft[k] = core::soft_step_of(view.solver, view.gravity_m_s2, view.dt_s, numbers);
    }
    // A step in several parts counts as lively, whatever its later parts begin with.
    view.calm_m_s = count_ > 1 ? -1.0F : core::calm_speed_m_s(view.gravity_m_s2, step_s);
  }

 private:
  core::SoftSettings solver_;
  float mass_ratio_ = 1.0F;
  bool is_calm_ = false;  // as the step begins
  std::uint32_t count_ = 1;
};

}  // namespace broadside::gpu
