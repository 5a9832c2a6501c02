#include "gpu/frame/pipeline.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "core/scene/refuse_turning.hpp"
#include "core/scene/refuse_wrenches.hpp"
#include "core/scene/springs_of_bodies.hpp"
#include "gpu/frame/pipeline_parts.hpp"

namespace broadside::gpu {

Pipeline::Pipeline(const PipelineOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
}
Pipeline::~Pipeline() = default;

Start Pipeline::Impl::chosen_start() const {
  // E2 and E7 are errors of the published scene octree: no other start would show them.
  if (options.variant == core::Variant::kE2 || options.variant == core::Variant::kE7) return Start::kOctree;
  switch (options.broad) {
    case Broad::kTree:
      if (scene != nullptr && scene->body_count() < options.least_for_grid) return Start::kTiles;
      return fits_grid(device_scene.box_facts()) ? Start::kGrid : Start::kTiles;
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
  if (core::Status s = core::refuse_turning(scene); !s) return s;
  if (core::Status s = core::refuse_wrenches(scene); !s) return s;
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
  d.broad_view = {};
  const float hash_cell_m = d.options.hash_cell_m > 0.0F ? d.options.hash_cell_m : scene.parameters.hash_cell_m;
  auto stream = frame_stream();
  if (!stream.ok()) return stream.error();
  d.stream = stream.value();
  BROADSIDE_TRY(d.copy_stream.create());
  // A digest of the scene that was loaded before may still be under way.
  BROADSIDE_TRY(wait_for_stream(d.stream, "the end of the scene before"));
  BROADSIDE_TRY(d.frames.create(d.stream));
  BROADSIDE_TRY(d.digests.allocate());
  SceneNeeds needs{hash_cell_m, d.options.least_for_cells};
  if (!d.options.has_vertex_stage) needs.least_for_cells = std::numeric_limits<std::uint32_t>::max();
  BROADSIDE_TRY(d.device_scene.load(scene, needs));
  BROADSIDE_TRY(d.broad.load(d.chosen_start(), d.device_scene.box_facts(), hash_cell_m, d.options.variant));
  BROADSIDE_TRY(d.buffers.load(scene));
  BROADSIDE_TRY(d.work.reset());
  auto launch = frame_launch_shape(d.device_scene.tree_levels());
  if (!launch.ok()) return launch.error();
  d.launch = launch.value();
  if (d.options.has_vertex_stage) BROADSIDE_TRY(d.buffers.reserve_leftovers());

  d.view.levels = d.options.levels;
  d.view.solver = d.options.solver;
  d.view.variant = d.options.variant;
  d.view.has_vertex_stage = d.options.has_vertex_stage;
  d.view.gravity_m_s2 = scene.gravity_m_s2;
  d.view.parameters = scene.parameters;
  d.view.domain = scene.domain;
  d.view.face_material = scene.face_material;
  d.view.stack_entries = stack_entries_of(d.device_scene.tree_levels());
  // One body a thread: with more, one block takes longer than the grid.
  d.view.block_bodies =
      std::min(d.launch.threads, static_cast<std::uint32_t>(d.launch.shared_bytes / sizeof(LiveBody)));
  d.view.block_bytes = d.launch.shared_bytes;
  d.device_scene.fill(d.view);
  // Uploads ran on the default stream, and this stream does not wait for that one.
  d.broad.fill(d.broad_view);
  d.buffers.fill(d.view);
  return wait_for_device("loading the scene");
}

std::uint32_t Pipeline::groups() const {
  using core::Group;
  std::uint32_t groups = core::bit(Group::kBodies) | core::bit(Group::kDetection) | core::bit(Group::kConfirmed) |
                         core::bit(Group::kContacts);
  if (impl_->starts_at_level0()) groups |= core::bit(Group::kPairs);
  return groups;
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
