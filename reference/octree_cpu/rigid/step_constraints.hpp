// The bodies and constraints of one step on which a contact solver works, and the impulses that the step before left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/pushed_apart.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/method/rigid/solver_body.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/impulse_memory.hpp"
#include "reference/octree_cpu/rigid/in_parallel.hpp"
#include "reference/octree_cpu/rigid/patch_coloring.hpp"
#include "reference/octree_cpu/rigid/patch_tiles.hpp"

namespace broadside::reference {

class StepConstraints {
 public:
  explicit StepConstraints(const PatchKernels& kernels) : tiles_(kernels) {}

  void begin(std::span<const core::RigidState> states, std::span<const core::ContactPatch> patches,
             const RigidStep& step, const core::SoftStep& numbers, const core::PatchLimits& limits);
  // Writes the states, and keeps the impulses of the last substep and of the step.
  void finish(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches, const RigidStep& step,
              std::uint32_t substeps);
  void forget() { memory_.forget(); }

  [[nodiscard]] std::span<core::SolverBody> bodies() { return bodies_; }
  [[nodiscard]] const PatchTiles& tiles() const { return tiles_; }
  [[nodiscard]] std::span<const PatchImpulses> impulses() const { return impulses_; }

  // work(index) for every body except the one that stands for the faces.
  template <typename Work>
  void each_body(const Work& work) {
    in_parallel(0, bodies_.size() - 1, work);
  }
  // work(range of tiles), in any order, so it must not write bodies.
  template <typename Work>
  void each_range(const Work& work) {
    ranges_in_parallel(0, tiles_.count(), work);
  }
  // The same, color by color, so work may write the moved bodies of its tiles.
  template <typename Work>
  void each_range_by_color(const Work& work) {
    const auto begin = tiles_.color_begin();
    for (std::size_t color = 0; color + 1 < begin.size(); ++color)
      ranges_in_parallel(begin[color], begin[color + 1], work);
  }

  // Call before the sweeps of a substep. Notes which patches are pushed apart (by place, as core::fastest_push says),
  // the impulses with which these patches begin, and the velocities with which all bodies begin.
  void note_pushed(std::span<const float> pushes, const core::SoftStep& numbers);
  [[nodiscard]] bool is_pushed() const { return fastest_push_m_s_ > 0.0F; }
  // Call after the bodies moved. Sets these patches back to those impulses, and moved bodies to those velocities, which
  // they had before any impulse of the substep.
  void take_back_impulses();
  // Call after one sweep of relaxation over all patches. Adds sweeps while needed, and returns how many.
  std::uint32_t relax_pushed(const core::SoftStep& numbers);

  // Sweeps of bounces since construction.
  [[nodiscard]] std::uint64_t bounce_sweeps() const { return bounce_sweeps_; }

  // Points that approached fast, and meet the other body in this substep for the first time in the step, rebound with
  // the restituted share of that speed. Sweeps go on until one changes no speed by more than 2^-10 of the fastest
  // approach; they visit patches whose bodies bounce or have just been changed by more than that. relaxed: by place,
  // how much relaxation changed a point's speed, m/s. Patches that it changed by more than numbers.stirring_m_s are
  // visited, too; then sweeps end where they change a speed by less than that. Where relaxation changed a patch by more
  // than numbers.begins_m_s, there are sweeps even if nothing bounces. forgets_blows: patches of bodies that these
  // sweeps reached keep no impulse (core/method/rigid/kept_blows.hpp).
  void bounce(const core::SoftStep& numbers, std::span<const float> relaxed, bool forgets_blows);

 private:
  template <typename Work>
  void ranges_in_parallel(std::size_t first, std::size_t last, const Work& work) {
    in_parallel_by(kTilesPerTask, first, last,
                   [&](std::size_t begin, std::size_t end) { work(tiles_.range(begin, end, bodies_.data())); });
  }
  [[nodiscard]] std::span<const core::ContactPatch> awake_of(std::span<const core::ContactPatch> patches,
                                                             const RigidStep& step);
  void recall(const core::ContactPatch& patch, core::PatchConstraint& c) const;
  // work(index) for the indices of each color; a color's indices end where those of the next begin.
  template <typename Work>
  void visit_by_color(const std::vector<std::uint32_t>& begin, const Work& work);
  // work(patch, a, b) for one patch, which is stored again. Returns what work returns.
  template <typename Work>
  float change(std::size_t place, const Work& work);
  // Sweeps over patches whose bodies are stirred, until one changes no point's speed by more than done_m_s, and at most
  // `most`. Returns how many.
  std::uint32_t relax_until_done(const core::SoftStep& numbers, float done_m_s, std::uint32_t most);
  // Patches of bodies that were stirred by this sweep or a later one keep no impulse.
  void drop_blows(std::uint32_t since);
  // Lists the places of patches with a point that approached fast enough to bounce.
  void list_fast();
  // Stirs the bodies of patches that bounce. Returns the fastest approach.
  float stir_what_bounces();
  // Stirs the bodies of patches that relaxation changed by more than `from`. Returns whether there are any.
  bool stir_what_relaxed(std::span<const float> relaxed, float from_m_s);
  void stir(std::size_t place, std::uint32_t sweep);

  // Patches, as given, of bodies that are awake: all patches where no body sleeps.
  std::vector<core::ContactPatch> awake_patches_;
  std::vector<std::uint32_t> awake_;  // their indices
  // The other patches: the impulses that they gave in the step before, and what they left.
  struct AsleepPatch {
    std::uint32_t patch;
    PatchImpulses given;
    std::array<RememberedPoint, core::kManifoldPoints> remembered;
  };
  std::vector<AsleepPatch> asleep_;
  PatchColoring coloring_;
  ImpulseMemory memory_;
  std::vector<core::SolverBody> bodies_;  // the last one stands for every face: it never moves
  PatchTiles tiles_;
  // By place: its bodies. Tiles know them too; this copy is for code that asks often.
  struct Bodies {
    std::uint32_t a;
    std::uint32_t b;
  };
  std::vector<Bodies> touched_;
  // What is restored when a push is taken back: impulses and velocities.
  struct PushedPatch {
    std::size_t place;
    core::PatchImpulsesBefore before;
  };
  std::vector<PushedPatch> pushed_;
  struct Velocity {
    core::Vec3 v;
    core::Vec3 angular_momentum;
  };
  std::vector<Velocity> driven_;  // by body; used if a patch is pushed
  float fastest_push_m_s_ = 0.0F;
  std::vector<PatchImpulses> impulses_;       // by patch as given
  std::vector<std::uint8_t> is_pushed_body_;  // by body: 1 = a patch gave it an impulse in the step
  std::vector<float> of_places_;  // by place or by entry of fast_: what a loop found, of which the largest is taken
  std::vector<std::uint8_t> came_fast_;  // by place: 1 = a point approached fast enough to bounce
  std::vector<std::uint32_t> fast_;      // places of these patches, by color
  std::vector<std::uint32_t> fast_begin_;
  // Of sweeps over stirred bodies: see StirredSweep.
  std::vector<std::uint32_t> stirred_;
  std::vector<std::uint8_t> followers_;
  std::vector<float> of_tiles_;
  std::vector<float> changes_;
  std::uint32_t sweep_ = 0;  // number of the present sweep over stirred bodies, counted over the step
  std::uint64_t bounce_sweeps_ = 0;
  float substep_s_ = 0.0F;
};

}  // namespace broadside::reference
