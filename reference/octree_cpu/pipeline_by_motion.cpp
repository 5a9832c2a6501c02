#include "reference/octree_cpu/pipeline_by_motion.hpp"

#include <utility>

#include "core/method/rigid/point_digest.hpp"

namespace broadside::reference {
namespace {

bool turns(const core::Scene& scene) {
  return scene.motion == core::Motion::kRigid;
}

}  // namespace

PipelineByMotion::PipelineByMotion(PipelineOptions translating, RigidPipelineOptions turning,
                                   core::Status why_not_rigid)
    : translating_(std::move(translating)), turning_(std::move(turning)), why_not_rigid_(std::move(why_not_rigid)) {}

core::Status PipelineByMotion::load(const core::Scene& scene) {
  if (turns(scene) && !why_not_rigid_) return why_not_rigid_;
  now_ = turns(scene) ? static_cast<core::Dynamics*>(&turning_) : &translating_;
  return now_->load(scene);
}

core::Declaration PipelineByMotion::declaration_for(const core::Scene& scene) const {
  return turns(scene) ? turning_.declaration_for(scene) : core::method_declaration();
}

std::uint32_t PipelineByMotion::groups_for(const core::Scene& scene) const {
  return turns(scene) ? turning_.groups() : translating_.groups();
}

std::string PipelineByMotion::digest_note_for(const core::Scene& scene) const {
  return turns(scene) ? std::string(core::kDigestWithPoints) : std::string();
}

}  // namespace broadside::reference
