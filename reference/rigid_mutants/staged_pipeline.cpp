#include "reference/rigid_mutants/staged_pipeline.hpp"

#include <utility>

#include "core/method/frame_digest.hpp"
#include "core/method/rigid/point_digest.hpp"
#include "reference/octree_cpu/rigid/rigid_declaration.hpp"
#include "reference/scene_octree/broad_phases.hpp"

namespace broadside::reference {
namespace {

// octree-cpu's default options, except those that the given stages change.
RigidPipelineOptions options_of(const TurningStages& stages) {
  RigidPipelineOptions options;
  options.sleeps = stages.sleeps;
  options.swept = stages.sweeps_fast ? core::Swept::kAll : core::Swept::kFlagged;
  options.make_broad_phase = [](const core::Scene&) { return make_tree_broad_phase(); };
  options.make_solver = [](const core::Scene&) { return make_contact_solver({}); };
  options.declare = [swept = options.swept](const core::Scene& scene) { return rigid_declaration({}, scene, swept); };
  return options;
}

// The digest of what is recorded, so that a wrong record is not found by its digest alone.
std::uint64_t digest_of(const core::FrameRecord& f) {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < f.position.size(); ++i)
    sum += core::body_digest(i, f.position[i], f.orientation[i], f.velocity[i], f.angular_velocity[i]);
  for (const core::Pair p : f.confirmed) sum += core::confirmed_digest(p);
  for (const core::ContactPoint& p : f.points) sum += core::point_digest(p);
  return sum;
}

}  // namespace

StagedPipeline::StagedPipeline(const TurningStages& stages, std::uint64_t run)
    : RigidPipeline(options_of(stages)), stages_(stages), run_(run) {}

core::Status StagedPipeline::load(const core::Scene& scene) {
  last_told = {};
  last_boxes.clear();
  last_touching.clear();
  last_placed = 0;
  return RigidPipeline::load(scene);
}

void StagedPipeline::place(float dt_s) {
  stages_.place != nullptr ? stages_.place(*this, dt_s) : sound_place(dt_s);
}

core::Status StagedPipeline::find_candidates() {
  return stages_.find_candidates != nullptr ? stages_.find_candidates(*this) : sound_find_candidates();
}

void StagedPipeline::confirm() {
  stages_.confirm != nullptr ? stages_.confirm(*this) : sound_confirm();
}

void StagedPipeline::touch_bodies() {
  stages_.touch_bodies != nullptr ? stages_.touch_bodies(*this) : sound_touch_bodies();
}

void StagedPipeline::touch_faces() {
  stages_.touch_faces != nullptr ? stages_.touch_faces(*this) : sound_touch_faces();
}

void StagedPipeline::respond(float dt_s) {
  stages_.respond != nullptr ? stages_.respond(*this, dt_s) : sound_respond(dt_s);
}

void StagedPipeline::wake() {
  stages_.wake != nullptr ? stages_.wake(*this) : sound_wake();
}

void StagedPipeline::fall_asleep(float dt_s) {
  stages_.fall_asleep != nullptr ? stages_.fall_asleep(*this, dt_s) : sound_fall_asleep(dt_s);
}

core::Status StagedPipeline::stop_short() {
  return stages_.stop_short != nullptr ? stages_.stop_short(*this) : sound_stop_short();
}

void StagedPipeline::tell_points() {
  stages_.tell_points != nullptr ? stages_.tell_points(*this) : sound_tell_points();
}

void StagedPipeline::record(core::FrameRecord& frame) {
  if (stages_.tell == nullptr) return;
  core::FrameRecord sound = frame;
  stages_.tell(*this, frame);
  frame.digest = digest_of(frame);
  last_told = std::move(sound);
}

}  // namespace broadside::reference
