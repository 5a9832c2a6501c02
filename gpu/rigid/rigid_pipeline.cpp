#include "gpu/rigid/rigid_pipeline.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/method/rigid/sleep.hpp"
#include "core/scene/refuse_springs.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "gpu/rigid/earlier_parts.hpp"
#include "gpu/rigid/parts_choice.hpp"
#include "gpu/rigid/rigid_buffers.hpp"
#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/rigid/rigid_read_back.hpp"
#include "gpu/rigid/rigid_scene.hpp"
#include "gpu/rigid/solve_team_choice.hpp"
#include "gpu/rigid/sweep_stage.hpp"
#include "gpu/rigid/told_frame.hpp"
#include "gpu/runtime/host_side.hpp"

namespace broadside::gpu {

struct RigidPipeline::Impl {
  RigidPipelineOptions options;
  const core::Scene* scene = nullptr;
  core::RigidBodies bodies;  // as loaded: states at the start
  StreamHandle stream = nullptr;
  RigidScene device_scene;
  RigidBuffers buffers;
  BroadBuffers broad;
  DeviceBuffer<core::Pair> pairs;
  DeviceBuffer<Counters> broad_counters;
  DeviceBuffer<unsigned long long> broad_barrier;
  Mapped<Outcome, 1> broad_outcome;
  Mapped<RigidOutcome, 1> outcome;
  PairsShape pairs_launch;
  LaunchShape contact_shape;
  LaunchShape near_contact_shape;
  LaunchShape constraint_shape;
  SolveShape solve_shape;
  LaunchShape sleep_shape;
  BoxFacts facts;
  RigidFrameView view;
  PairsView pairs_view;
  ToldFrame told;
  SweepStage sweep;
  RigidCounts last;
  std::uint64_t last_pairs = 0;
  std::array<core::StageTime, core::kStageCount> times{};
  std::uint64_t steps = 0;
  std::uint64_t repeats = 0;
  std::uint64_t patches_made = 0;
  std::uint64_t pairs_tested = 0;
  std::uint64_t sweeps = 0;
  std::uint64_t bounce_sweeps = 0;
  std::uint64_t waits = 0;
  std::uint64_t steps_slept = 0;
  std::uint64_t launches = 0;
  float dt_s = 0.0F;    // of the step
  float part_s = 0.0F;  // length of the last part that was kept
  PartsChoice parts;
  std::uint32_t part = 1;  // the part that is being taken
  EarlierParts earlier_parts;

  [[nodiscard]] bool has_broad() const;
  [[nodiscard]] Start start() const;
  core::Status load_broad();
  core::Status refit(const RigidCounts& counts);
  void fill();
  core::Status run_part();
  [[nodiscard]] bool has_two_contact_launches() const { return view.has_long_contacts || view.follows_ways; }
  core::Status launch_contacts_of_scene();
  core::Status launch_all();
  core::Result<bool> is_kept();
  [[nodiscard]] RigidLeft left() const { return left_of(bodies, buffers, pairs, last_pairs, last); }
  [[nodiscard]] bool was_in_parts() const { return parts.count() > 1 && steps > 0; }
  core::Status read_back_joined(core::FrameRecord& frame, core::RecordLevel level) const;
  // The frame is kept: the next one starts from the state that it ended in.
  void take_frame();
};

namespace {

template <typename Value>
core::Status take(const core::Result<Value>& result, Value& into) {
  if (!result.ok()) return result.error();
  into = result.value();
  return core::Done{};
}

// Cells of the broad phase are made for boxes this much larger than those seen so far, because boxes grow with the
// speed of their bodies.
constexpr float kRoomForSpeed = 1.25F;
// Room for eight overlaps a body, and more when a frame finds more.
constexpr std::uint64_t kPairsPerBody = 8;

std::uint32_t as_word(float v) {
  return std::bit_cast<std::uint32_t>(v);
}

}  // namespace

RigidPipeline::RigidPipeline(const RigidPipelineOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
RigidPipeline::~RigidPipeline() = default;

// As in the twin: with broad=brute the levels test all pairs, and there is no broad phase.
bool RigidPipeline::Impl::has_broad() const {
  return options.broad != Broad::kBrute;
}

Start RigidPipeline::Impl::start() const {
  if (options.broad == Broad::kOctree) return Start::kOctree;
  const auto count = static_cast<std::uint32_t>(bodies.state.size());
  if (options.broad != Broad::kTree || count < options.least_for_grid || !fits_grid(facts)) return Start::kTiles;
  return count < kLeastBoxesForBulk ? Start::kGrid : Start::kBulk;
}

core::Status RigidPipeline::Impl::load_broad() {
  const std::size_t n = bodies.state.size();
  auto shape =
      pairs_launch_shape(start(), facts.count, static_cast<std::uint32_t>(grid_buckets(n)), {kLeastBoxesForBins});
  if (!shape.ok()) return shape.error();
  pairs_launch = shape.value();
  BROADSIDE_TRY(broad.load(start(), facts, 0.0F, core::Variant::kSound, pairs_launch.bins, pairs_launch.sort.blocks));
  return wait_for_device("clearing the broad phase");
}

// Chooses cells for boxes of these sizes and places.
core::Status RigidPipeline::Impl::refit(const RigidCounts& counts) {
  const auto side = std::bit_cast<float>(counts.largest_side);
  const auto coordinate = std::bit_cast<float>(counts.largest_coordinate);
  const float most = std::numeric_limits<float>::max() / (2.0F * kRoomForSpeed);
  if (!(side < most && coordinate < most))
    return core::Error{"a body's state is no longer finite", "step " + std::to_string(steps + 1) + " of octree-gpu",
                       "take a shorter step, or look for bodies that start inside each other"};
  const Start before = start();
  facts.largest_side_m = std::max(facts.largest_side_m, kRoomForSpeed * side);
  facts.coordinate_range_m = std::max(facts.coordinate_range_m, kRoomForSpeed * coordinate);
  if (start() != before) return load_broad();
  broad.refit(facts);
  return core::Done{};
}

core::Status RigidPipeline::load(const core::Scene& scene) {
  BROADSIDE_TRY(core::refuse_springs(scene));
  Impl& d = *impl_;
  auto bodies = core::make_rigid_bodies(scene);
  if (!bodies.ok()) return bodies.error();
  d.bodies = std::move(bodies).value();
  d.bodies.is_swept = core::swept_bodies(scene, d.options.swept);
  d.scene = &scene;
  d.steps = d.repeats = d.patches_made = d.pairs_tested = d.last_pairs = 0;
  d.sweeps = d.bounce_sweeps = d.waits = d.steps_slept = d.launches = 0;
  d.dt_s = d.part_s = 0.0F;
  d.last = {};
  d.parts = PartsChoice(d.options.solver, scene, !d.bodies.is_swept.empty());
  d.earlier_parts.begin();
  d.told.forget();
  d.times = {};
  d.view = {};
  d.pairs_view = {};
  auto stream = frame_stream();
  if (!stream.ok()) return stream.error();
  d.stream = stream.value();
  BROADSIDE_TRY(wait_for_stream(d.stream, "the end of the scene before"));
  BROADSIDE_TRY(d.device_scene.load(scene, d.bodies));
  const auto some_are = [&](core::ContactKind kind) {
    return std::ranges::any_of(d.bodies.shapes, [&](const core::RigidShape& s) { return s.contact.kind == kind; });
  };
  const bool has_hulls = some_are(core::ContactKind::kHull);
  BROADSIDE_TRY(d.buffers.load(d.bodies.state, d.options.sleeps, has_hulls));
  BROADSIDE_TRY(d.outcome.allocate());
  BROADSIDE_TRY(d.broad_outcome.allocate());
  BROADSIDE_TRY(d.broad_counters.reserve(1, "counters"));
  BROADSIDE_TRY(d.broad_counters.fill_bytes(0));
  BROADSIDE_TRY(d.broad_barrier.reserve(1, "barrier"));
  BROADSIDE_TRY(d.broad_barrier.fill_bytes(0));
  const std::size_t n = d.bodies.state.size();
  BROADSIDE_TRY(d.pairs.reserve(std::max<std::uint64_t>(1024, kPairsPerBody * n), "pairs"));
  d.view.has_long_contacts = has_hulls || some_are(core::ContactKind::kMesh);
  d.view.follows_ways = !d.bodies.is_swept.empty();
  BROADSIDE_TRY(
      take(d.has_two_contact_launches() ? long_contact_launch_shape() : contact_launch_shape(), d.contact_shape));
  BROADSIDE_TRY(take(near_contact_launch_shape(), d.near_contact_shape));
  BROADSIDE_TRY(take(constraint_launch_shape(), d.constraint_shape));
  BROADSIDE_TRY(take(solve_launch_shape(), d.solve_shape));
  BROADSIDE_TRY(take(sleep_launch_shape(), d.sleep_shape));

  if (d.view.follows_ways) BROADSIDE_TRY(d.sweep.load(d.bodies));

  d.facts = {};
  d.facts.count = static_cast<std::uint32_t>(n);
  d.facts.low_corner = scene.domain.min;
  d.facts.domain = scene.domain;
  BROADSIDE_TRY(d.load_broad());

  d.view.body_count = static_cast<std::uint32_t>(n);
  d.view.levels = d.options.levels;
  d.view.has_broad = d.has_broad();
  d.view.gravity_m_s2 = scene.gravity_m_s2;
  d.view.domain = scene.domain;
  d.view.face_material = scene.face_material;
  d.view.solver =
      d.options.has_fixed_thresholds ? core::with_fixed_thresholds(d.options.solver, scene) : d.options.solver;
  d.device_scene.fill(d.view);
  return wait_for_device("loading the scene");
}

void RigidPipeline::Impl::fill() {
  buffers.fill(view);
  parts.fill(view, dt_s, part == 1);
  view.sleep.speed_m_s = core::sleep_speed_m_s(scene->gravity_m_s2, dt_s);
  view.sleep.decides = part == parts.count();
  view.sleep.share = part_s > 0.0F ? view.dt_s / part_s : 1.0F;
  view.pairs = pairs.data();
  view.pair_capacity = pairs.capacity();
  view.broad_counters = broad_counters.data();
  view.outcome = outcome.device(0);
  // Tiles need no cells.
  const bool has_cells = has_broad() && start() != Start::kTiles;
  view.side_limit = has_cells ? as_word(facts.largest_side_m) : as_word(std::numeric_limits<float>::max());
  view.coordinate_limit = has_cells ? as_word(facts.coordinate_range_m) : as_word(std::numeric_limits<float>::max());
  broad.fill(pairs_view.broad);
  broad.fill(pairs_view.bulk);
  pairs_view.box_count = view.body_count;
  pairs_view.boxes = view.boxes;
  pairs_view.pairs = {pairs.data(), pairs.capacity()};
  pairs_view.counters = broad_counters.data();
  pairs_view.barrier = broad_barrier.data();
  pairs_view.outcome = broad_outcome.device(0);
}

core::Status RigidPipeline::Impl::launch_contacts_of_scene() {
  if (!has_two_contact_launches()) return launch_contacts(view, contact_shape, stream);
  ++launches;
  BROADSIDE_TRY(launch_near_contacts(view, near_contact_shape, stream));
  return launch_long_contacts(view, contact_shape, stream);
}

core::Status RigidPipeline::Impl::launch_all() {
  fill();
  const SolveTeamChoice solve = choose_solve_team(solve_shape, view.body_count, options.may_cluster);
  view.solve_team = solve.kind;
  view.constraints.has_pairs = solve.kind == SolveTeamKind::kGrid && view.body_count >= options.least_for_pairs;
  BROADSIDE_TRY(launch_place(view, contact_shape, stream));
  // Cells are chosen from boxes of earlier frames. At the first frame there are none, and with cells of size 0 a box
  // would look for partners in billions of cells. So the broad phase is left out: the kernels after it find that the
  // boxes are too large for their cells, and the frame is repeated.
  const bool lacks_cells = start() != Start::kTiles && start() != Start::kOctree && facts.largest_side_m == 0.0F;
  if (has_broad() && !lacks_cells) BROADSIDE_TRY(launch_pairs(pairs_view, pairs_launch, stream));
  BROADSIDE_TRY(launch_contacts_of_scene());
  // The speed below which bodies are still follows from gravity; without gravity it is 0, and no body sleeps.
  const bool may_sleep = options.sleeps && view.sleep.speed_m_s > 0.0F;
  launches += may_sleep ? 7 : 5;
  if (may_sleep) BROADSIDE_TRY(launch_wake(view, sleep_shape, stream));
  BROADSIDE_TRY(launch_constraints(view, constraint_shape, stream));
  BROADSIDE_TRY(launch_solve(view, solve.blocks, stream));
  if (may_sleep) BROADSIDE_TRY(launch_fall_asleep(view, sleep_shape, stream));
  return wait_for_stream(stream, "a frame");
}

// Returns whether the frame is kept. After an abort, arrays that were too small have grown, and an island that was
// touched is awake; the frame is then launched again from the same state.
core::Result<bool> RigidPipeline::Impl::is_kept() {
  last = outcome[0].counts;
  if (last.is_aborted == 0) return true;
  ++repeats;
  if (part == 1 && parts.replan(last, view)) return false;
  if (last.largest_side > view.side_limit || last.largest_coordinate > view.coordinate_limit) {
    BROADSIDE_TRY(refit(last));
    return false;
  }
  if (has_broad() && broad_outcome[0].counters.is_aborted != 0) {
    BROADSIDE_TRY(broad.grow(broad_outcome[0].counters));
    BROADSIDE_TRY(pairs.reserve(broad_outcome[0].counters.pairs + broad_outcome[0].counters.pairs / 4, "pairs"));
    return false;
  }
  BROADSIDE_TRY(buffers.grow(last));
  return false;
}

void RigidPipeline::Impl::take_frame() {
  unsigned long long begin_ns = outcome[0].begin_ns;
  for (std::size_t k = 0; k < core::kStageCount; ++k) {
    // The broad phase ends where the kernel after it begins; boxes and pairs are timed together.
    const unsigned long long end_ns = k == 0 ? begin_ns : outcome[0].stage_end_ns[k];
    times[k] = {core::kStageNames[k], times[k].seconds + static_cast<double>(end_ns - begin_ns) * 1e-9};
    begin_ns = end_ns;
  }
  buffers.advance(last);
  last_pairs = has_broad() ? broad_outcome[0].counters.pairs : 0;
  const std::uint64_t n = bodies.state.size();
  pairs_tested += has_broad() ? last_pairs : n * (n - 1) / 2;
  patches_made += last.patches;
  sweeps += last.done.sweeps;
  bounce_sweeps += last.done.bounce_sweeps;
  waits += last.done.waits;
  steps_slept += last.asleep_bodies;
}

core::Status RigidPipeline::Impl::run_part() {
  for (bool is_done = false; !is_done;) {
    BROADSIDE_TRY(launch_all());
    const auto kept = is_kept();
    if (!kept.ok()) return kept.error();
    is_done = kept.value();
  }
  if (view.follows_ways) BROADSIDE_TRY(sweep.stop_short(view, view.after, stream));
  take_frame();
  part_s = view.dt_s;
  return core::Done{};
}

core::Status RigidPipeline::step(float dt_s) {
  Impl& d = *impl_;
  // The time for which a body has been still is counted in steps, so all steps counted must have one length.
  if (dt_s != d.dt_s) BROADSIDE_TRY(d.buffers.wake_all());
  d.dt_s = dt_s;
  d.times = {};
  d.earlier_parts.begin();
  for (d.part = 1;; ++d.part) {
    BROADSIDE_TRY(d.run_part());
    if (d.part == d.parts.count()) break;
    BROADSIDE_TRY(d.earlier_parts.keep(d.left(), d.stream));
  }
  ++d.steps;
  return core::Done{};
}

core::Status RigidPipeline::Impl::read_back_joined(core::FrameRecord& frame, core::RecordLevel level) const {
  BROADSIDE_TRY(read_back_rigid(left(), frame));
  return earlier_parts.join(bodies, frame, level);
}

core::Status RigidPipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  Impl& d = *impl_;
  frame = {};
  frame.step = d.steps;
  frame.time_s = static_cast<double>(d.steps) * static_cast<double>(d.dt_s);
  frame.parts = d.was_in_parts() ? d.parts.count() : 1;
  if (d.was_in_parts()) return d.read_back_joined(frame, level);
  const RigidLeft left = d.left();
  auto digest = rigid_digest_of(left, d.contact_shape, d.stream);
  if (!digest.ok()) return digest.error();
  frame.digest = digest.value();
  return level == core::RecordLevel::kFull ? read_back_rigid(left, frame) : core::Status(core::Done{});
}

core::Result<core::DeviceFrame> RigidPipeline::frame_on_device() {
  Impl& d = *impl_;
  if (d.scene == nullptr) return core::Error{"it has no scene", "octree-gpu", "load one first", core::Exit::kInternal};
  if (d.was_in_parts()) {
    core::FrameRecord joined;
    BROADSIDE_TRY(d.read_back_joined(joined, core::RecordLevel::kFull));
    return d.told.upload(joined, d.steps);
  }
  return d.told.tell(d.left(), d.steps, d.stream);
}

std::uint32_t RigidPipeline::groups() const {
  using core::Group;
  const std::uint32_t always = core::bit(Group::kBodies) | core::bit(Group::kDetection) |
                               core::bit(Group::kDetectedOrientation) | core::bit(Group::kConfirmed) |
                               core::bit(Group::kPoints) | core::bit(Group::kPartPoses);
  return impl_->has_broad() ? always | core::bit(Group::kPairs) : always;
}

std::span<const core::StageTime> RigidPipeline::stage_times() const {
  if (impl_->steps == 0) return {};
  return impl_->times;
}

std::vector<core::Counter> RigidPipeline::counters() const {
  const Impl& d = *impl_;
  std::vector<core::Counter> counters{
      {"launches", d.launches},
      {"level stage: pairs tested", d.pairs_tested},
      {"contact patches", d.patches_made},
      {"solver: sweeps", d.sweeps},
      {"solver: sweeps of bounces", d.bounce_sweeps},
      {"solver: waits", d.waits},
      {"device bytes", d.device_scene.bytes() + d.buffers.bytes() + d.broad.bytes() + d.pairs.bytes() +
                           d.sweep.bytes() + d.earlier_parts.bytes()}};
  if (d.view.follows_ways) counters.push_back({"sweep: bodies stopped short", d.sweep.stopped()});
  if (d.options.sleeps) counters.push_back({"sleep: bodies asleep", d.steps_slept});
  return counters;
}

std::uint64_t RigidPipeline::repeated_frames() const {
  return impl_->repeats;
}

}  // namespace broadside::gpu
