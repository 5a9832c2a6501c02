#include "gpu/pipeline.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "core/scene/springs_of_bodies.hpp"
#include "gpu/broad_buffers.hpp"
#include "gpu/device_scene.hpp"
#include "gpu/frame_buffers.hpp"
#include "gpu/frame_copy.hpp"
#include "gpu/frame_kernel.hpp"
#include "gpu/host_side.hpp"
#include "gpu/work_counter.hpp"

namespace broadside::gpu {
namespace {

constexpr std::array<std::string_view, kStageCount> kStageNames{"integrate", "broad",    "levels",
                                                                "vertices",  "response", "faces"};

}  // namespace

struct Pipeline::Impl {
  PipelineOptions options;
  const core::Scene* scene = nullptr;
  Stream stream;
  Stream copy_stream;
  OutcomeMemory outcome;
  DeviceScene device_scene;
  FrameBuffers buffers;
  BroadBuffers broad;
  StreamMark frame_end;
  LaunchShape launch;
  WorkCounter work;
  FrameView view;
  Counters last;
  std::array<core::StageTime, kStageCount> times{};
  std::uint64_t steps = 0;
  std::uint64_t repeats = 0;
  std::uint64_t pairs_tested = 0;
  std::uint64_t all_pairs = 0;  // of the scene, without those of two static bodies
  // The step whose digest was asked for last, and how long after the one before. 0 before the first.
  std::uint64_t asked_step = 0;
  std::uint64_t asked_stride = 0;
  bool has_digest = false;  // that of the last step is on its way: its kernel is in the stream
  // Frames on their way to the host: two, by turns.
  std::array<FrameCopy, 2> copies;
  std::uint64_t copies_started = 0;
  std::uint64_t copies_finished = 0;
  double dt_s = 0.0;

  [[nodiscard]] bool is_confirmed_by_level0() const {
    return view.broad.start != Start::kNone && view.levels == core::Levels::kFlat;
  }
  [[nodiscard]] std::uint64_t confirmed_count() const { return is_confirmed_by_level0() ? last.pairs : last.confirmed; }
  [[nodiscard]] Start chosen_start() const;
  [[nodiscard]] bool starts_at_level0() const { return chosen_start() != Start::kNone; }
  // Whether somebody will ask for the digest of the next frame, to judge by when they asked before.
  [[nodiscard]] bool expects_digest() const { return steps > 0 && steps + 1 == asked_step + asked_stride; }
  core::Status run_frame();
  core::Status count_work();
  core::Status start_digest(const StateView& state, std::uint64_t step);
  void take_digests();
};

Pipeline::Pipeline(const PipelineOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
Pipeline::~Pipeline() = default;

Start Pipeline::Impl::chosen_start() const {
  // E2 and E7 are faults of the published scene octree: without it there would be nothing to see.
  if (options.variant == core::Variant::kE2 || options.variant == core::Variant::kE7) return Start::kOctree;
  switch (options.broad) {
    case Broad::kTree:
      return scene != nullptr && scene->body_count() < options.least_for_grid ? Start::kTiles : Start::kGrid;
    case Broad::kOctree:
      return Start::kOctree;
    case Broad::kHash:
      return Start::kHash;
    case Broad::kBrute:
      break;
  }
  const bool has_level0 = options.levels == core::Levels::kFlat || options.levels == core::Levels::kC;
  return has_level0 ? Start::kTiles : Start::kNone;
}

core::Status Pipeline::load(const core::Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!(scene.bodies[i].angular_velocity == core::Vec3{}))
      return core::Error{"angular_velocity is not zero, and this pipeline's bodies translate only",
                         scene.name + ": body " + std::to_string(i), "set angular_velocity to 0 0 0"};
  }
  Impl& d = *impl_;
  BROADSIDE_TRY(core::check_spring_step(scene, d.options.variant));
  d.scene = &scene;
  d.steps = d.repeats = d.pairs_tested = d.copies_started = d.copies_finished = d.asked_step = d.asked_stride = 0;
  const auto pairs_of = [](std::uint64_t bodies) { return bodies < 2 ? 0 : bodies * (bodies - 1) / 2; };
  const auto fixed = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                   [](const core::Body& body) { return body.inverse_mass == 0.0F; });
  d.all_pairs = pairs_of(scene.bodies.size()) - pairs_of(static_cast<std::uint64_t>(fixed));
  d.last = {};
  d.has_digest = false;
  d.times = {};
  d.view = {};
  const float hash_cell_m = d.options.hash_cell_m > 0.0F ? d.options.hash_cell_m : scene.parameters.hash_cell_m;
  BROADSIDE_TRY(d.stream.create());
  BROADSIDE_TRY(d.copy_stream.create());
  // A digest of the scene before may be under way.
  BROADSIDE_TRY(d.stream.wait("the end of the scene before"));
  BROADSIDE_TRY(d.outcome.allocate());
  SceneNeeds needs{hash_cell_m, d.options.least_for_cells};
  if (!d.options.has_vertex_stage) needs.least_for_cells = std::numeric_limits<std::uint32_t>::max();
  BROADSIDE_TRY(d.device_scene.load(scene, needs));
  BROADSIDE_TRY(d.broad.load(d.chosen_start(), d.device_scene.box_facts(), hash_cell_m, d.options.variant));
  BROADSIDE_TRY(d.buffers.load(scene));
  BROADSIDE_TRY(d.work.reset());
  auto launch = frame_launch_shape(d.device_scene.tree_levels());
  if (!launch.ok()) return launch.error();
  d.launch = launch.value();

  d.view.levels = d.options.levels;
  d.view.solver = d.options.solver;
  d.view.variant = d.options.variant;
  d.view.has_vertex_stage = d.options.has_vertex_stage;
  d.view.gravity_m_s2 = scene.gravity_m_s2;
  d.view.parameters = scene.parameters;
  d.view.domain = scene.domain;
  d.view.face_material = scene.face_material;
  d.view.stack_entries = stack_entries_of(d.device_scene.tree_levels());
  // One body a thread: with more, a block takes longer than the grid.
  d.view.block_bodies =
      std::min(d.launch.threads, static_cast<std::uint32_t>(d.launch.shared_bytes / sizeof(LiveBody)));
  d.view.outcome = d.outcome.device();
  d.device_scene.fill(d.view);
  // Uploads ran on the default stream, which this one does not wait for.
  d.broad.fill(d.view.broad);
  d.buffers.fill(d.view);
  return wait_for_device("loading the scene");
}

core::Status Pipeline::Impl::run_frame() {
  buffers.fill(view);
  broad.fill(view.broad);
  if (is_confirmed_by_level0()) view.confirmed.items = view.pairs.items;
  // Few blocks meet sooner at a barrier; more than one a multiprocessor pays when there is work for them.
  LaunchShape shape = launch;
  if (view.body_count < kLeastBodiesForGrid) shape.blocks = std::min(shape.blocks, shape.multiprocessors);
  BROADSIDE_TRY(launch_frame(view, shape, stream.get()));
  if (!has_digest) return stream.wait("a frame");
  // The digest is added up while the host sees to its next launch: only the frame is waited for.
  BROADSIDE_TRY(frame_end.set(stream.get()));
  BROADSIDE_TRY(start_digest(view.next, steps + 1));
  return frame_end.wait("a frame");
}

core::Status Pipeline::step(float dt_s) {
  Impl& d = *impl_;
  d.view.dt_s = dt_s;
  d.has_digest = d.expects_digest();
  for (;;) {
    BROADSIDE_TRY(d.run_frame());
    d.last = (*d.outcome).counters;
    if (d.last.is_aborted == 0) break;
    BROADSIDE_TRY(d.broad.grow(d.last));
    BROADSIDE_TRY(d.buffers.grow(d.last, d.is_confirmed_by_level0()));
    ++d.repeats;
  }
  BROADSIDE_TRY(d.count_work());
  // What was in the stream before this frame is done.
  d.take_digests();
  d.buffers.advance();
  ++d.steps;
  d.pairs_tested += d.starts_at_level0() ? d.last.pairs : d.all_pairs;
  d.dt_s = static_cast<double>(dt_s);
  const auto& end = (*d.outcome).stage_end_ns;
  for (int k = 0; k < kStageCount; ++k) d.times[k] = {kStageNames[k], static_cast<double>(end[k + 1] - end[k]) * 1e-9};
  return core::Done{};
}

// Of the frame that was just computed; nothing where nobody asked.
core::Status Pipeline::Impl::count_work() {
  const BroadWorkView of_broad{view.broad, {}, view.boxes, view.body_count, view.counters};
  BROADSIDE_TRY(work.count_broad(of_broad, launch.multiprocessors, stream.get()));
  if (is_confirmed_by_level0()) return core::Done{};
  return work.count_levels(view, launch.multiprocessors, stream.get());
}

core::Status Pipeline::Impl::start_digest(const StateView& state, std::uint64_t step) {
  DigestView digest;
  digest.body_count = scene->body_count();
  digest.state = state;
  digest.orientation = device_scene.orientation();
  digest.is_confirmed_by_level0 = is_confirmed_by_level0();
  digest.confirmed = digest.is_confirmed_by_level0 ? buffers.pairs().data() : buffers.confirmed().data();
  digest.contacts = buffers.contacts().data();
  digest.face_contacts = buffers.face_contacts().data();
  digest.counters = view.counters;
  digest.digest = &outcome.device()->digest[step % 2];
  return launch_digest(digest, launch.multiprocessors, stream.get());
}

// For copies under way whose digests are done.
void Pipeline::Impl::take_digests() {
  for (std::uint64_t k = copies_finished; k < copies_started; ++k) {
    FrameCopy& copy = copies[k % copies.size()];
    if (!copy.has_digest) copy.begun.digest = (*outcome).digest[copy.begun.step % 2];
    copy.has_digest = true;
  }
}

std::uint32_t Pipeline::groups() const {
  using core::Group;
  std::uint32_t groups = core::bit(Group::kBodies) | core::bit(Group::kDetection) | core::bit(Group::kConfirmed) |
                         core::bit(Group::kContacts);
  if (impl_->starts_at_level0()) groups |= core::bit(Group::kPairs);
  return groups;
}

core::Status Pipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  BROADSIDE_TRY(start_copy(level));
  return finish_copy(frame);
}

core::Status Pipeline::start_copy(core::RecordLevel level) {
  Impl& d = *impl_;
  if (d.copies_started - d.copies_finished == d.copies.size())
    return core::Error{"a third copy of a frame was started", "octree-gpu", "finish one first", core::Exit::kInternal};
  FrameCopy& copy = d.copies[d.copies_started % d.copies.size()];
  copy.begun = {};
  copy.begun.step = d.steps;
  copy.begun.time_s = static_cast<double>(d.steps) * d.dt_s;
  copy.begun.pairs_demanded = copy.begun.pairs_raw = d.last.pairs;
  FrameCounts counts;
  counts.bodies = d.scene->bodies.size();
  counts.pairs = d.last.pairs;
  counts.confirmed = d.confirmed_count();
  counts.proximity = d.options.has_vertex_stage ? counts.confirmed : 0;
  counts.contacts = d.last.touching;
  counts.face_contacts = d.last.faces;
  if (d.asked_step != d.steps) d.asked_stride = d.steps - d.asked_step;
  d.asked_step = d.steps;
  if (!d.has_digest) BROADSIDE_TRY(d.start_digest(d.buffers.state().view(), d.steps));
  d.has_digest = true;
  copy.has_digest = false;
  copy.is_full = level == core::RecordLevel::kFull;
  if (copy.is_full)
    BROADSIDE_TRY(copy.start(d.buffers, counts, d.is_confirmed_by_level0(), d.stream.get(), d.copy_stream.get()));
  ++d.copies_started;
  return core::Done{};
}

core::Status Pipeline::finish_copy(core::FrameRecord& frame) {
  Impl& d = *impl_;
  if (d.copies_finished == d.copies_started)
    return core::Error{"no copy of a frame is under way", "octree-gpu", "start one first", core::Exit::kInternal};
  FrameCopy& copy = d.copies[d.copies_finished % d.copies.size()];
  if (!copy.has_digest) {
    BROADSIDE_TRY(d.stream.wait("the digest of a frame"));
    d.take_digests();
  }
  ++d.copies_finished;
  frame = copy.begun;
  if (!copy.is_full) return core::Done{};
  BROADSIDE_TRY(copy.finish(frame));
  for (const core::Body& body : d.scene->bodies) {
    frame.orientation.push_back(body.orientation);
    frame.angular_velocity.push_back(body.angular_velocity);
  }
  return core::Done{};
}

std::span<const core::StageTime> Pipeline::stage_times() const {
  if (impl_->steps == 0) return {};
  return impl_->times;
}

std::vector<core::Counter> Pipeline::counters() const {
  const MemoryUse memory = memory_use();
  std::vector<core::Counter> counters{{"launches", impl_->steps + impl_->repeats},
                                      {"level stage: pairs tested", impl_->pairs_tested},
                                      {"device bytes", memory.shapes + memory.bodies + memory.appended}};
  impl_->work.tell(counters);
  return counters;
}

void Pipeline::count_work() {
  impl_->work.ask();
}

const Counters& Pipeline::frame_counts() const {
  return impl_->last;
}

MemoryUse Pipeline::memory_use() const {
  const Impl& d = *impl_;
  return {d.device_scene.shape_bytes(), d.device_scene.body_bytes() + d.buffers.body_bytes() + d.broad.bytes(),
          d.buffers.appended_bytes()};
}

std::uint64_t Pipeline::repeated_frames() const {
  return impl_->repeats;
}

}  // namespace broadside::gpu
