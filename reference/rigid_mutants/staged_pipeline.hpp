// octree-cpu where bodies turn, with its stages as a table of functions; a wrong engine replaces one of them.
#pragma once

#include <cstdint>

#include "core/trace/frame.hpp"
#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"

namespace broadside::reference {

class StagedPipeline;

// Null: the pipeline's own stage.
struct TurningStages {
  void (*place)(StagedPipeline&, float dt_s) = nullptr;
  core::Status (*find_candidates)(StagedPipeline&) = nullptr;
  void (*confirm)(StagedPipeline&) = nullptr;
  void (*touch_bodies)(StagedPipeline&) = nullptr;
  void (*touch_faces)(StagedPipeline&) = nullptr;
  void (*respond)(StagedPipeline&, float dt_s) = nullptr;
  void (*tell_points)(StagedPipeline&) = nullptr;
  void (*wake)(StagedPipeline&) = nullptr;
  void (*fall_asleep)(StagedPipeline&, float dt_s) = nullptr;
  core::Status (*stop_short)(StagedPipeline&) = nullptr;
  // Changes what is recorded of the frame, and nothing else.
  void (*tell)(StagedPipeline&, core::FrameRecord&) = nullptr;
  // Settings that are off by default.
  bool sleeps = false;
  bool sweeps_fast = false;
};

// With default stages: octree-cpu of scenes whose bodies turn, bit for bit.
class StagedPipeline final : public RigidPipeline {
 public:
  // run: 0, 1, ...: lets a mutant differ from run to run.
  explicit StagedPipeline(const TurningStages& stages, std::uint64_t run = 0);

  core::Status load(const core::Scene& scene) override;
  [[nodiscard]] std::uint64_t run() const { return run_; }
  [[nodiscard]] const core::Scene& scene() const { return *scene_; }
  // Number of the step that is being computed, from 1.
  [[nodiscard]] std::uint64_t step_number() const { return steps() + 1; }

  // The right stages, which a replaced one may call, and the data that they work on.
  void sound_place(float dt_s) { RigidPipeline::place(dt_s); }
  core::Status sound_find_candidates() { return RigidPipeline::find_candidates(); }
  void sound_confirm() { RigidPipeline::confirm(); }
  void sound_touch_bodies() { RigidPipeline::touch_bodies(); }
  void sound_touch_faces() { RigidPipeline::touch_faces(); }
  void sound_respond(float dt_s) { RigidPipeline::respond(dt_s); }
  void sound_wake() { RigidPipeline::wake(); }
  void sound_fall_asleep(float dt_s) { RigidPipeline::fall_asleep(dt_s); }
  core::Status sound_stop_short() { return RigidPipeline::stop_short(); }
  void sound_tell_points() { RigidPipeline::tell_points(); }
  using RigidPipeline::bodies_;
  using RigidPipeline::candidates_;
  using RigidPipeline::confirmed_;
  using RigidPipeline::patches_;
  using RigidPipeline::points_;
  using RigidPipeline::sleepers_;
  // The last recorded frame and the step that was placed last, for stages that lag behind.
  core::FrameRecord last_told;
  std::vector<core::Box> last_boxes;
  std::vector<core::ContactPatch> last_touching;
  std::uint64_t last_placed = 0;  // the step, of whose first part last_boxes are kept

 protected:
  void place(float dt_s) override;
  core::Status find_candidates() override;
  void confirm() override;
  void touch_bodies() override;
  void touch_faces() override;
  void respond(float dt_s) override;
  void wake() override;
  void fall_asleep(float dt_s) override;
  core::Status stop_short() override;
  void tell_points() override;
  void record(core::FrameRecord& frame) override;

 private:
  TurningStages stages_;
  std::uint64_t run_;
};

}  // namespace broadside::reference
