#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "core/contact.hpp"
#include "core/method/frame_digest.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/point_digest.hpp"
#include "core/method/rigid/rigid_declaration.hpp"
#include "core/method/rigid/sleep.hpp"
#include "core/method/rigid/told_point.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "core/scene/pace.hpp"
#include "core/scene/refuse_springs.hpp"
#include "reference/octree_cpu/parallel_sum.hpp"
#include "reference/octree_cpu/rigid/push_stage.hpp"
#include "reference/octree_cpu/stage_clock.hpp"

namespace broadside::reference {

struct RigidPipeline::Threads {
  tbb::task_arena arena;
};

RigidPipeline::RigidPipeline(RigidPipelineOptions options)
    : options_(std::move(options)),
      threads_(new Threads{
          tbb::task_arena(options_.threads > 0 ? options_.threads : static_cast<int>(tbb::task_arena::automatic))}) {}

RigidPipeline::~RigidPipeline() = default;

core::Declaration RigidPipeline::declaration_for(const core::Scene& scene) const {
  if (!options_.sleeps) return options_.declare(scene);
  return core::with_sleep(options_.declare(scene), core::sleep_speed_m_s(scene.gravity_m_s2, scene.dt_s));
}

core::Status RigidPipeline::load(const core::Scene& scene) {
  if (core::Status s = core::refuse_springs(scene); !s) return s;
  auto bodies = core::make_rigid_bodies(scene);
  if (!bodies) return bodies.error();
  scene_ = &scene;
  bodies_ = std::move(bodies).value();
  solver_ = options_.make_solver(scene);
  mass_ratio_ = core::largest_mass_ratio(scene);
  plan_ = {};
  earlier_parts_.begin();
  sleepers_.load(bodies_);
  last_patches_.clear();
  dt_s_ = part_s_ = 0.0F;
  steps_ = 0;
  candidates_ = {};
  confirmed_.clear();
  patches_.clear();
  points_.clear();
  level_stage_.reset_counts();
  bodies_.is_swept = core::swept_bodies(scene, options_.swept);
  patch_stage_.load(scene, !options_.sleeps);
  sweep_stage_.load(scene, bodies_, options_.make_broad_phase);
  if (!options_.make_broad_phase) return core::Done{};
  broad_phase_ = options_.make_broad_phase(scene);
  threads_->arena.execute([&] { place(scene.dt_s); });
  return broad_phase_->load(bodies_.boxes, bodies_.is_static);
}

core::Status RigidPipeline::step(float dt_s) {
  const core::Pace pace = core::pace_of(bodies_, bodies_.state, dt_s);
  is_calm_ = core::is_calm(pace, scene_->gravity_m_s2, dt_s);
  plan_ = solver_->plan_of_step(mass_ratio_, is_calm_, pace.stride, !bodies_.is_swept.empty());
  // The time for which a body has been still is counted in steps, so all steps counted must have one length.
  if (dt_s != dt_s_) sleepers_.wake_all();
  const float part_s = dt_s / static_cast<float>(plan_.parts);
  times_ = {};
  earlier_parts_.begin();
  for (std::uint32_t part = 1; part <= plan_.parts; ++part) {
    core::Status status = core::Done{};
    const bool is_last = part == plan_.parts;
    threads_->arena.execute([&] { status = run_stages(part_s, is_last ? dt_s : 0.0F); });
    if (!status) return status;
    part_s_ = part_s;
    if (is_last) break;
    core::FrameRecord frame;
    read_back_part(frame, core::RecordLevel::kFull);
    earlier_parts_.add(std::move(frame));
  }
  ++steps_;
  dt_s_ = dt_s;
  return core::Done{};
}

core::Status RigidPipeline::run_stages(float dt_s, float ended_step_s) {
  StageClock clock(times_);
  place(dt_s);
  clock.lap(core::Stage::kIntegrate);
  if (core::Status s = find_candidates(); !s) return s;
  clock.lap(core::Stage::kBroad);
  confirm();
  clock.lap(core::Stage::kConfirm);
  touch_bodies();
  if (options_.sleeps) wake();
  clock.lap(core::Stage::kVertices);
  touch_faces();
  clock.lap(core::Stage::kFaces);
  respond(dt_s);
  if (options_.sleeps && ended_step_s > 0.0F) fall_asleep(ended_step_s);
  if (!bodies_.is_swept.empty())
    if (core::Status s = stop_short(); !s) return s;
  tell_points();
  clock.lap(core::Stage::kResponse);
  return core::Done{};
}

// Stores the pose of detection, how far each body can move from there, and a box that contains all of its places.
void RigidPipeline::place(float dt_s) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, bodies_.count(), 256), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      const core::RigidState& s = bodies_.detected[i] = bodies_.state[i];
      const core::RigidShape& shape = bodies_.shapes[bodies_.shape[i]];
      const core::FreeMotion motion =
          core::free_motion(s, bodies_.mass[i], shape.balls, scene_->gravity_m_s2, bodies_.wrench_of(i), dt_s);
      bodies_.free_end[i] = core::free_end(s, bodies_.mass[i], scene_->gravity_m_s2, bodies_.wrench_of(i), dt_s);
      const core::PushWord push = core::stronger_push(bodies_.push[i], bodies_.passed_on[i]);
      bodies_.push[i] = bodies_.passed_on[i] = 0;
      bodies_.pushed_by[i] = core::pusher_of(push);
      bodies_.pushed[i] = core::pushed_way(push, motion.drift, dt_s * bodies_.state[core::pusher_of(push)].v);
      bodies_.drift[i] = motion.drift;
      bodies_.swing_m[i] = motion.swing_m;
      bodies_.reach_m[i] = motion.reach_m() + core::length(bodies_.pushed[i]);
      bodies_.fall_m[i] = core::length(motion.fall);
      bodies_.shape_boxes[i] = core::turned_box(shape.contact, shape.vertices(), s.x, s.q);
      const int steps = core::steps_ahead(motion, shape.half_thickness_m);
      bodies_.boxes[i] = core::pushed_box(core::swept_box(bodies_.shape_boxes[i], motion, steps), bodies_.pushed[i]);
    }
  });
}

core::Status RigidPipeline::find_candidates() {
  if (!broad_phase_) return core::Done{};
  if (core::Status s = broad_phase_->update(bodies_.boxes); !s) return s;
  if (core::Status s = broad_phase_->find(); !s) return s;
  auto found = broad_phase_->read_back();
  if (!found) return found.error();
  candidates_ = std::move(found).value();
  return core::Done{};
}

void RigidPipeline::confirm() {
  if (broad_phase_)
    level_stage_.confirm(bodies_, options_.levels, candidates_.pairs, confirmed_);
  else
    level_stage_.confirm_all(bodies_, options_.levels, confirmed_);
  pass_on_pushes(bodies_, confirmed_);
}

void RigidPipeline::touch_bodies() {
  patch_stage_.touch_bodies(bodies_, confirmed_, sleepers_.asleep());
}

void RigidPipeline::touch_faces() {
  last_patches_.swap(patches_);
  patch_stage_.touch_faces(bodies_, confirmed_, sleepers_.asleep(), patches_);
  if (sleepers_.is_anybody_asleep()) keep_sleeping_patches();
}

// A body that wakes may touch others that sleep, so this repeats until no island wakes.
void RigidPipeline::wake() {
  while (sleepers_.wake_touched(patch_stage_.of_bodies())) touch_bodies();
}

void RigidPipeline::fall_asleep(float dt_s) {
  sleepers_.fall_asleep(bodies_, patches_, scene_->gravity_m_s2, dt_s);
}

// Sleeping bodies keep their patches.
void RigidPipeline::keep_sleeping_patches() {
  const auto asleep = sleepers_.asleep();
  const auto is_asleep = [&](const core::ContactPatch& p) {
    return asleep[p.a] != 0 || (!core::is_face(p.b) && asleep[p.b] != 0);
  };
  std::vector<core::ContactPatch> awake;
  awake.swap(patches_);
  std::erase_if(last_patches_, [&](const core::ContactPatch& p) { return !is_asleep(p); });
  patches_.reserve(awake.size() + last_patches_.size());
  std::merge(
      awake.begin(), awake.end(), last_patches_.begin(), last_patches_.end(), std::back_inserter(patches_),
      [](const core::ContactPatch& p, const core::ContactPatch& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

void RigidPipeline::respond(float dt_s) {
  const float asleep_share = part_s_ > 0.0F ? dt_s / part_s_ : 1.0F;
  const RigidStep step{bodies_.mass,
                       bodies_.material,
                       bodies_.wrench,
                       scene_->face_material,
                       scene_->gravity_m_s2,
                       dt_s,
                       sleepers_.asleep(),
                       asleep_share,
                       is_calm_,
                       plan_};
  solver_->advance(bodies_.state, patches_, step);
}

core::Status RigidPipeline::stop_short() {
  return sweep_stage_.stop_short(bodies_);
}

// Points that touched or were pushed. Patches are sorted, so points are too.
void RigidPipeline::tell_points() {
  points_.clear();
  const auto impulses = solver_->impulses();
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const core::ContactPatch& patch = patches_[k];
    for (int i = 0; i < patch.manifold.count; ++i) {
      core::ContactPoint told;
      if (core::told_point(patch, i, impulses[k][static_cast<std::size_t>(i)], bodies_.detected[patch.a].x, told))
        points_.push_back(told);
    }
  }
}

std::uint32_t RigidPipeline::groups() const {
  using core::Group;
  const std::uint32_t always = bit(Group::kBodies) | bit(Group::kDetection) | bit(Group::kDetectedOrientation) |
                               bit(Group::kConfirmed) | bit(Group::kPoints) | bit(Group::kPartPoses);
  return options_.make_broad_phase ? always | bit(Group::kPairs) : always;
}

std::vector<core::Counter> RigidPipeline::counters() const {
  std::vector<core::Counter> counters;
  if (broad_phase_) counters = broad_phase_->counters();
  counters.push_back({"level stage: pairs tested", level_stage_.pairs_tested()});
  counters.push_back({"level stage: box tests", level_stage_.box_tests()});
  counters.push_back({"contact patches", patch_stage_.patches_made()});
  counters.push_back({"contact patches carried", patch_stage_.patches_carried()});
  if (solver_) {
    const SolverSweeps sweeps = solver_->sweeps_done();
    counters.push_back({"solver: sweeps", sweeps.solving});
    counters.push_back({"solver: sweeps of bounces", sweeps.bouncing});
  }
  if (options_.sleeps) counters.push_back({"sleep: bodies asleep", sleepers_.steps_slept()});
  if (!bodies_.is_swept.empty()) counters.push_back({"sweep: bodies stopped short", sweep_stage_.stopped()});
  return counters;
}

std::uint64_t RigidPipeline::digest() const {
  const auto body = [this](std::size_t i) {
    const core::RigidState& s = bodies_.state[i];
    const auto k = static_cast<std::uint32_t>(i);
    return core::body_digest(k, bodies_.origin(k), s.q, s.v, bodies_.spin(k));
  };
  std::uint64_t sum = 0;
  threads_->arena.execute([&] {
    sum = parallel_sum_of(bodies_.count(), body) +
          parallel_sum_of(confirmed_.size(), [this](std::size_t k) { return core::confirmed_digest(confirmed_[k]); }) +
          parallel_sum_of(points_.size(), [this](std::size_t k) { return core::point_digest(points_[k]); });
  });
  return sum;
}

core::Status RigidPipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  const bool is_in_parts = plan_.parts > 1 && steps_ > 0;
  read_back_part(frame, is_in_parts ? core::RecordLevel::kFull : level);
  frame.step = steps_;
  frame.time_s = static_cast<double>(steps_) * static_cast<double>(dt_s_);
  if (is_in_parts) earlier_parts_.join(frame, level);
  frame.parts = steps_ > 0 ? plan_.parts : 1;
  if (level == core::RecordLevel::kFull) record(frame);
  return core::Done{};
}

void RigidPipeline::read_back_part(core::FrameRecord& frame, core::RecordLevel level) {
  frame = {};
  frame.digest = digest();
  if (level != core::RecordLevel::kFull) return;

  for (std::uint32_t i = 0; i < bodies_.count(); ++i) {
    const core::RigidState& s = bodies_.state[i];
    frame.position.push_back(bodies_.origin(i));
    frame.orientation.push_back(s.q);
    frame.velocity.push_back(s.v);
    frame.angular_velocity.push_back(bodies_.spin(i));
    const core::RigidState& d = bodies_.detected[i];
    frame.detected_position.push_back(core::mesh_origin(bodies_.mass[i], d));
    frame.detected_velocity.push_back(d.v);
    frame.detected_orientation.push_back(d.q);
  }
  frame.boxes = bodies_.boxes;
  frame.pairs = candidates_.pairs;
  frame.pairs_demanded = candidates_.demanded;
  frame.pairs_raw = candidates_.raw;
  frame.confirmed = confirmed_;
  frame.points = points_;
}

}  // namespace broadside::reference
