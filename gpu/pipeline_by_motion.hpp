// octree-gpu's dynamics: METHOD's pipeline for scenes whose bodies translate, RIGID 8's for scenes whose bodies turn.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/engine/chosen_by_scene.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/frame_copies.hpp"
#include "core/engine/frame_on_device.hpp"
#include "core/engine/runs_ahead.hpp"
#include "core/engine/work_counting.hpp"
#include "gpu/frame/pipeline.hpp"
#include "gpu/rigid/rigid_pipeline.hpp"

namespace broadside::gpu {

class PipelineByMotion final : public core::Dynamics,
                               public core::RunsAhead,
                               public core::FrameCopies,
                               public core::FrameOnDevice,
                               public core::CountsWork,
                               public core::ChosenByScene {
 public:
  // twin: the engine that gives the same bits. why_not_rigid: an error if a setting asks for something that only METHOD
  // has, so that bodies may not turn; else no error.
  PipelineByMotion(const PipelineOptions& translating, const RigidPipelineOptions& turning, std::string twin,
                   core::Status why_not_rigid);

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override { return now_->step(dt_s); }
  // Steps of turning bodies follow one another: none is launched ahead.
  core::Status run(float dt_s, std::uint64_t steps, const StepDone& step_done) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return now_->read_back(frame, level);
  }
  // Frames of turning bodies are copied at once, and are kept here until finish_copy.
  core::Status start_copy(core::RecordLevel level) override;
  core::Status finish_copy(core::FrameRecord& frame) override;
  [[nodiscard]] core::Result<core::DeviceFrame> frame_on_device() override {
    return is_turning() ? turning_.frame_on_device() : translating_.frame_on_device();
  }
  void count_work() override { translating_.count_work(); }
  [[nodiscard]] std::uint32_t groups() const override { return now_->groups(); }
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override { return now_->stage_times(); }
  [[nodiscard]] std::vector<core::Counter> counters() const override { return now_->counters(); }

  [[nodiscard]] core::Declaration declaration_for(const core::Scene& scene) const override;
  [[nodiscard]] std::uint32_t groups_for(const core::Scene& scene) const override;
  [[nodiscard]] std::string digest_note_for(const core::Scene& scene) const override;

 private:
  [[nodiscard]] bool is_turning() const { return now_ == &turning_; }

  Pipeline translating_;
  RigidPipeline turning_;
  RigidPipelineOptions turning_options_;
  std::string twin_;
  core::Status why_not_rigid_;
  core::Dynamics* now_ = &translating_;  // the pipeline for the scene that was loaded last
  std::deque<core::FrameRecord> copied_;
};

}  // namespace broadside::gpu
