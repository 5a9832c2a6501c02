// A contact solver for bodies that turn: it advances states by one step, with gravity, wrenches and contact. RIGID 8.5.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/material.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/scene/scene.hpp"

namespace broadside::reference {

// What acts in one step. Spans are by body.
struct RigidStep {
  std::span<const core::RigidMass> masses;
  std::span<const core::Material> materials;
  std::span<const core::RigidWrench> wrenches;  // or none
  core::Material face_material;
  core::Vec3 gravity_m_s2;
  float dt_s = 0.0F;
  // By body, or empty: 1 = asleep. The patches of a sleeping body are those of the step before, and their impulses are
  // those of that step times asleep_share. No awake body has a patch with a sleeping one.
  std::span<const std::uint8_t> asleep;
  float asleep_share = 1.0F;
  bool is_calm = false;  // as the step began: core::is_calm
  core::StepPlan plan;   // of the whole step, where this is a part of one
};

// Of one patch, by point: N s on A, of the whole step.
using PatchImpulses = std::array<core::Vec3, core::kManifoldPoints>;

// Sweeps over all patches so far, for measurements.
struct SolverSweeps {
  std::uint64_t solving = 0;   // before the bodies move, and where pushes are taken back
  std::uint64_t bouncing = 0;  // while contacts bounce, or relax what pushes left
};

class ContactSolver {
 public:
  virtual ~ContactSolver() = default;

  // states: by body, at the pose of detection. patches: sorted by (a, b); those of one pair in an order that is a
  // function of the pair. The result is a function of the arguments and of the calls before, not of the number of
  // threads. Call it inside the oneTBB arena that it may use.
  virtual void advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
                       const RigidStep& step) = 0;

  // In how many parts a step is to be taken, with a call of advance for each: core::plan_of_step.
  [[nodiscard]] virtual core::StepPlan plan_of_step(float largest_mass_ratio, bool is_calm, float stride,
                                                    bool are_swept) const = 0;

  // The impulses of the last step, by patch.
  [[nodiscard]] virtual std::span<const PatchImpulses> impulses() const = 0;

  [[nodiscard]] virtual SolverSweeps sweeps_done() const = 0;

  // Forgets the steps before: the next one begins without a warm start.
  virtual void forget() = 0;
};

// Substeps with soft contacts: along conjugate directions until they are solved, or one sweep each (Catto's soft step).
enum class SolverKind { kConjugate, kSoftStep };

inline constexpr SolverKind kSolverKinds[] = {SolverKind::kConjugate, SolverKind::kSoftStep};

std::string_view solver_name(SolverKind kind);

struct ContactSolverOptions {
  SolverKind kind = SolverKind::kConjugate;
  std::uint32_t substeps = 0;  // 0 = the kind's own
  // Fixed thresholds of the scene, in place of those that scale with bodies, gravity and step; 0 = they scale.
  float fixed_slop_m = 0.0F;
  float fixed_bounce_from_m_s = 0.0F;
};

core::SoftSettings soft_settings(const ContactSolverOptions& options);

std::unique_ptr<ContactSolver> make_soft_solver(const core::SoftSettings& settings);
std::unique_ptr<ContactSolver> make_contact_solver(const ContactSolverOptions& options);

}  // namespace broadside::reference
