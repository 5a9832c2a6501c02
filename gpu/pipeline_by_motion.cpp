#include "gpu/pipeline_by_motion.hpp"

#include <utility>

#include "core/method/rigid/point_digest.hpp"
#include "core/method/rigid/rigid_declaration.hpp"
#include "core/method/rigid/sleep.hpp"

namespace broadside::gpu {
namespace {

bool turns(const core::Scene& scene) {
  return scene.motion == core::Motion::kRigid;
}

}  // namespace

PipelineByMotion::PipelineByMotion(const PipelineOptions& translating, const RigidPipelineOptions& turning,
                                   std::string twin, core::Status why_not_rigid)
    : translating_(translating),
      turning_(turning),
      turning_options_(turning),
      twin_(std::move(twin)),
      why_not_rigid_(std::move(why_not_rigid)) {}

core::Status PipelineByMotion::load(const core::Scene& scene) {
  if (turns(scene) && !why_not_rigid_) return why_not_rigid_;
  now_ = turns(scene) ? static_cast<core::Dynamics*>(&turning_) : &translating_;
  copied_.clear();
  return now_->load(scene);
}

core::Status PipelineByMotion::run(float dt_s, std::uint64_t steps, const StepDone& step_done) {
  if (!is_turning()) return translating_.run(dt_s, steps, step_done);
  for (std::uint64_t k = 0; k < steps; ++k) {
    if (core::Status s = turning_.step(dt_s); !s) return s;
    if (!step_done()) break;
  }
  return core::Done{};
}

core::Status PipelineByMotion::start_copy(core::RecordLevel level) {
  if (!is_turning()) return translating_.start_copy(level);
  copied_.emplace_back();
  return turning_.read_back(copied_.back(), level);
}

core::Status PipelineByMotion::finish_copy(core::FrameRecord& frame) {
  if (!is_turning()) return translating_.finish_copy(frame);
  frame = std::move(copied_.front());
  copied_.pop_front();
  return core::Done{};
}

core::Declaration PipelineByMotion::declaration_for(const core::Scene& scene) const {
  if (!turns(scene)) return core::method_declaration(twin_);
  core::Declaration awake = core::rigid_declaration(turning_options_.solver, scene, turning_options_.swept, twin_);
  if (!turning_options_.sleeps) return awake;
  return core::with_sleep(awake, core::sleep_speed_m_s(scene.gravity_m_s2, scene.dt_s));
}

std::uint32_t PipelineByMotion::groups_for(const core::Scene& scene) const {
  return turns(scene) ? turning_.groups() : translating_.groups();
}

std::string PipelineByMotion::digest_note_for(const core::Scene& scene) const {
  return turns(scene) ? std::string(core::kDigestWithPoints) : std::string();
}

}  // namespace broadside::gpu
