#include "reference/octree_cpu/pipeline.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <string>
#include <utility>

#include "core/method/frame_digest.hpp"
#include "core/method/integrate.hpp"
#include "core/scene/refuse_turning.hpp"
#include "core/scene/refuse_wrenches.hpp"
#include "core/scene/springs_of_bodies.hpp"
#include "reference/octree_cpu/parallel_sum.hpp"
#include "reference/octree_cpu/stage_clock.hpp"
#include "reference/octree_cpu/vertex_stage.hpp"
#include "reference/scene_octree/octree_record.hpp"

namespace broadside::reference {
struct Pipeline::Threads {
  tbb::task_arena arena;
};

Pipeline::Pipeline(PipelineOptions options)
    : options_(std::move(options)),
      threads_(new Threads{
          tbb::task_arena(options_.threads > 0 ? options_.threads : static_cast<int>(tbb::task_arena::automatic))}) {}

Pipeline::~Pipeline() = default;

core::Status Pipeline::load(const core::Scene& scene) {
  if (core::Status s = core::refuse_turning(scene); !s) return s;
  if (core::Status s = core::refuse_wrenches(scene); !s) return s;
  scene_ = &scene;
  bodies_ = make_bodies(scene);
  rules_ = {scene.parameters, options_.variant, options_.solver, scene.domain, scene.face_material};
  steps_ = 0;
  told_at_.reset();
  still_digest_.clear();
  for (std::uint32_t i = 0; i < bodies_.count(); ++i)
    still_digest_.push_back(core::still_body_digest(i, scene.bodies[i].orientation, scene.bodies[i].angular_velocity));
  if (core::Status s = core::check_spring_step(scene, options_.variant); !s) return s;
  level_stage_.reset_counts();
  if (!options_.make_broad_phase) return core::Done{};
  broad_phase_ = options_.make_broad_phase(scene);
  for (std::uint32_t i = 0; i < bodies_.count(); ++i)
    bodies_.boxes[i] = core::translated(bodies_.local_box(i), bodies_.state[i].x);
  return broad_phase_->load(bodies_.boxes, bodies_.is_static);
}

core::Status Pipeline::step(float dt_s) {
  core::Status status = core::Done{};
  threads_->arena.execute([&] { status = run_stages(dt_s); });
  return status;
}

core::Status Pipeline::run_stages(float dt_s) {
  times_ = {};
  StageClock clock(times_);
  integrate(dt_s);
  clock.lap(core::Stage::kIntegrate);
  if (core::Status s = find_candidates(); !s) return s;
  // The published start of level 0 is a broad phase, and is timed as one, as on the GPU.
  const bool confirms_all_by_level0 = !broad_phase_ && has_level0();
  if (confirms_all_by_level0) confirm();
  clock.lap(core::Stage::kBroad);
  if (!confirms_all_by_level0) confirm();
  clock.lap(core::Stage::kConfirm);
  touch();
  clock.lap(core::Stage::kVertices);
  response_.resolve_bodies(bodies_, rules_, touching_);
  clock.lap(core::Stage::kResponse);
  response_.resolve_faces(bodies_, rules_);
  clock.lap(core::Stage::kFaces);
  ++steps_;
  dt_s_ = dt_s;
  return core::Done{};
}

void Pipeline::integrate(float dt_s) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, bodies_.count(), 1024), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      core::Vec3 acceleration = scene_->gravity_m_s2;
      for (const core::Spring& s : bodies_.springs_of(i))
        acceleration = acceleration + core::spring_acceleration(s, bodies_.state[i], bodies_.inverse_mass[i]);
      bodies_.state[i] = core::semi_implicit_euler(bodies_.state[i], bodies_.inverse_mass[i], acceleration, dt_s);
      bodies_.detected[i] = bodies_.state[i];
      bodies_.boxes[i] = core::translated(bodies_.local_box(i), bodies_.state[i].x);
    }
  });
}

core::Status Pipeline::find_candidates() {
  if (!broad_phase_) return core::Done{};
  if (core::Status s = broad_phase_->update(bodies_.boxes); !s) return s;
  if (core::Status s = broad_phase_->find(); !s) return s;
  auto found = broad_phase_->read_back();
  if (!found) return found.error();
  candidates_ = std::move(found).value();
  return core::Done{};
}

void Pipeline::confirm() {
  if (broad_phase_)
    level_stage_.confirm(bodies_, options_.levels, candidates_.pairs, confirmed_);
  else
    level_stage_.confirm_all(bodies_, options_.levels, confirmed_);
}

// Level 0 from the published start is a broad phase too: what it confirms is the candidate set.
bool Pipeline::has_level0() const {
  return options_.make_broad_phase != nullptr || options_.levels == core::Levels::kFlat;
}

void Pipeline::touch() {
  if (!options_.has_vertex_stage) {
    touching_ = confirmed_;
    return;
  }
  measure_proximity(bodies_, rules_.parameters, confirmed_, proximity_);
  touching_.clear();
  for (std::size_t k = 0; k < confirmed_.size(); ++k)
    if (proximity_[k].is_touching()) touching_.push_back(confirmed_[k]);
}

std::uint32_t Pipeline::groups() const {
  using core::Group;
  std::uint32_t groups = core::bit(Group::kBodies) | core::bit(Group::kDetection) | core::bit(Group::kConfirmed) |
                         core::bit(Group::kContacts) | core::bit(Group::kBodyOctree);
  if (has_level0()) groups |= core::bit(Group::kPairs);
  if (options_.records_octree) groups |= core::bit(Group::kOctree);
  return groups;
}

// The counters of the broad phase, then those of the level stage.
std::vector<core::Counter> Pipeline::counters() const {
  std::vector<core::Counter> counters;
  if (broad_phase_) counters = broad_phase_->counters();
  counters.push_back({"level stage: pairs tested", level_stage_.pairs_tested()});
  counters.push_back({"level stage: box tests", level_stage_.box_tests()});
  return counters;
}

std::uint64_t Pipeline::digest() const {
  const auto body = [this](std::size_t i) {
    return core::body_digest(still_digest_[i], bodies_.state[i].x, bodies_.state[i].v);
  };
  std::uint64_t sum = 0;
  threads_->arena.execute([&] {
    sum = parallel_sum_of(bodies_.count(), body) +
          parallel_sum_of(confirmed_.size(), [this](std::size_t k) { return core::confirmed_digest(confirmed_[k]); }) +
          response_.digest();
  });
  return sum;
}

void Pipeline::tell_octrees(core::FrameRecord& frame) {
  if (const auto* octree = dynamic_cast<const OctreeRecord*>(broad_phase_.get()))
    octree->tell_octree(frame.octree_nodes, frame.octree_node_of_body);
  // Shapes do not change, so only the record of the first recorded step contains their octrees, however often it is
  // read.
  if (!told_at_) told_at_ = steps_;
  if (*told_at_ != steps_) return;
  frame.shape_of_body = bodies_.shape;
  for (const ShapeData& s : bodies_.shapes) {
    const core::BodyOctree& tree = s.shape.octree;
    frame.body_octree_boxes.insert(frame.body_octree_boxes.end(), tree.boxes.begin(), tree.boxes.end());
    frame.leaf_of_vertex.insert(frame.leaf_of_vertex.end(), tree.leaf_of_vertex.begin(), tree.leaf_of_vertex.end());
  }
}

core::Status Pipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  frame = {};
  frame.step = steps_;
  frame.time_s = static_cast<double>(steps_) * static_cast<double>(dt_s_);
  frame.digest = digest();
  if (level != core::RecordLevel::kFull) return core::Done{};

  for (std::uint32_t i = 0; i < bodies_.count(); ++i) {
    frame.position.push_back(bodies_.state[i].x);
    frame.velocity.push_back(bodies_.state[i].v);
    frame.orientation.push_back(scene_->bodies[i].orientation);
    frame.angular_velocity.push_back(scene_->bodies[i].angular_velocity);
    frame.detected_position.push_back(bodies_.detected[i].x);
    frame.detected_velocity.push_back(bodies_.detected[i].v);
  }
  frame.boxes = bodies_.boxes;
  if (broad_phase_) {
    frame.pairs = candidates_.pairs;
    frame.pairs_demanded = candidates_.demanded;
    frame.pairs_raw = candidates_.raw;
  } else if (has_level0()) {
    frame.pairs = confirmed_;
    frame.pairs_demanded = frame.pairs_raw = confirmed_.size();
  }
  frame.confirmed = confirmed_;
  if (options_.has_vertex_stage) frame.proximity = proximity_;
  response_.collect(frame.contacts);
  tell_octrees(frame);
  return core::Done{};
}

}  // namespace broadside::reference
