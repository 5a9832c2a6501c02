// octree-cpu's dynamics: METHOD's pipeline for scenes whose bodies translate, RIGID 8's for scenes whose bodies turn.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine/chosen_by_scene.hpp"
#include "core/engine/dynamics.hpp"
#include "reference/octree_cpu/pipeline.hpp"
#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"

namespace broadside::reference {

class PipelineByMotion final : public core::Dynamics, public core::ChosenByScene {
 public:
  // why_not_rigid: the error for scenes whose bodies turn, where a setting asks for something that METHOD alone has;
  // otherwise no error.
  PipelineByMotion(PipelineOptions translating, RigidPipelineOptions turning, core::Status why_not_rigid);

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override { return now_->step(dt_s); }
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return now_->read_back(frame, level);
  }
  [[nodiscard]] std::uint32_t groups() const override { return now_->groups(); }
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override { return now_->stage_times(); }
  [[nodiscard]] std::vector<core::Counter> counters() const override { return now_->counters(); }

  [[nodiscard]] core::Declaration declaration_for(const core::Scene& scene) const override;
  [[nodiscard]] std::uint32_t groups_for(const core::Scene& scene) const override;
  [[nodiscard]] std::string digest_note_for(const core::Scene& scene) const override;

 private:
  Pipeline translating_;
  RigidPipeline turning_;
  core::Status why_not_rigid_;
  core::Dynamics* now_ = &translating_;  // the pipeline of the scene that was loaded last
};

}  // namespace broadside::reference
