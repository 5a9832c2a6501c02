// The CPU twin of bodies that turn: RIGID 8. Reads like reference/octree_cpu/pipeline.hpp; its formulas are those of
// core/method/rigid/.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/contact_point.hpp"
#include "core/engine/broad_phase.hpp"
#include "core/engine/declaration.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/stage.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "core/pair.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "core/scene/swept_bodies.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"
#include "reference/octree_cpu/rigid/oriented_level_stage.hpp"
#include "reference/octree_cpu/rigid/patch_stage.hpp"
#include "reference/octree_cpu/rigid/sleepers.hpp"
#include "reference/octree_cpu/rigid/sweep_stage.hpp"

namespace broadside::reference {

struct RigidPipelineOptions {
  // Makes the broad phase over the scene's domain; empty = the level stage tests every pair.
  std::function<std::unique_ptr<core::BroadPhase>(const core::Scene&)> make_broad_phase;
  core::Levels levels = core::Levels::kC;
  std::function<std::unique_ptr<ContactSolver>(const core::Scene&)> make_solver;
  std::function<core::Declaration(const core::Scene&)> declare;  // of these stages with this solver
  // Which bodies stop before they pass through others when they move farther than they are thick.
  core::Swept swept = core::Swept::kFlagged;
  bool sleeps = false;  // islands that stand still stop being solved
  int threads = 0;      // 0 = all
};

// A step detects contacts at its start, for all places that bodies can reach within it, and moves bodies last. A step
// may be taken in several parts, each of which does this anew: where masses are far apart, or bodies move far. The bits
// are the same for any number of threads: every parallel loop writes to slots of its own, and what depends on an order
// is done in a fixed one.
class RigidPipeline : public core::Dynamics {
 public:
  explicit RigidPipeline(RigidPipelineOptions options);
  ~RigidPipeline() override;

  // Refuses springs, and shapes and masses that no body can have.
  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] std::uint32_t groups() const override;
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override { return times_; }
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  // The speed below which a body counts as still depends on the scene.
  [[nodiscard]] core::Declaration declaration_for(const core::Scene& scene) const;

 protected:
  // The stages, in order. A wrong engine replaces one.
  virtual void place(float dt_s);
  virtual core::Status find_candidates();
  virtual void confirm();
  virtual void touch_bodies();
  virtual void touch_faces();
  virtual void respond(float dt_s);
  // Only where bodies may sleep: wake before the response, fall_asleep after it.
  virtual void wake();
  virtual void fall_asleep(float dt_s);
  // Only where bodies are swept.
  virtual core::Status stop_short();
  virtual void tell_points();
  // The last stage: it may change what is recorded.
  virtual void record(core::FrameRecord&) {}

  const core::Scene* scene_ = nullptr;
  core::RigidBodies bodies_;
  PatchStage patch_stage_;
  Sleepers sleepers_;
  SweepStage sweep_stage_;
  core::PairSet candidates_;
  std::vector<core::Pair> confirmed_;
  std::vector<core::ContactPatch> patches_;
  std::vector<core::ContactPoint> points_;  // of the last step

  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  // Runs the stages of a step, or of a part of one. ended_step_s: the length of the step that this ends; 0 if a further
  // part follows.
  core::Status run_stages(float dt_s, float ended_step_s);
  void read_back_part(core::FrameRecord& frame, core::RecordLevel level);
  [[nodiscard]] std::uint64_t digest() const;
  void keep_sleeping_patches();

  struct Threads;  // oneTBB's arena: vendor headers stay in the source

  RigidPipelineOptions options_;
  std::unique_ptr<Threads> threads_;
  std::unique_ptr<core::BroadPhase> broad_phase_;
  OrientedLevelStage level_stage_;
  std::unique_ptr<ContactSolver> solver_;
  std::array<core::StageTime, core::kStageCount> times_{};
  std::vector<core::ContactPatch> last_patches_;  // of the step before, where bodies may sleep
  float dt_s_ = 0.0F;                             // of the step
  float part_s_ = 0.0F;                           // of the last part that was taken
  std::uint64_t steps_ = 0;
  float mass_ratio_ = 1.0F;  // core::largest_mass_ratio
  bool is_calm_ = false;     // whether the step began calm
  core::StepPlan plan_;      // of the step
  core::StepInParts earlier_parts_;
};

}  // namespace broadside::reference
