// What a pipeline hands out of a frame: its digest, and copies that are made while later frames are computed.
#include "gpu/frame/pipeline_parts.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {

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
  digest.digest = digests.device(step % 2);
  return launch_digest(digest, launch.multiprocessors, stream);
}

// Gives the copies under way their digests, which are done.
void Pipeline::Impl::take_digests() {
  for (std::uint64_t k = copies_finished; k < copies_started; ++k) {
    FrameCopy& copy = copies[k % copies.size()];
    if (!copy.has_digest) copy.begun.digest = digests[copy.begun.step % 2];
    copy.has_digest = true;
  }
}

core::Status Pipeline::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  BROADSIDE_TRY(start_copy(level));
  return finish_copy(frame);
}

core::Result<core::DeviceFrame> Pipeline::frame_on_device() {
  const Impl& d = *impl_;
  if (d.scene == nullptr) return core::Error{"it has no scene", "octree-gpu", "load one first", core::Exit::kInternal};
  auto device = current_device();
  if (!device.ok()) return device.error();
  const StateView state = d.buffers.state().view();
  const std::uint64_t bodies = d.scene->bodies.size();
  core::DeviceFrame frame;
  frame.columns = {{"body/position", state.position, bodies, 3, sizeof(PackedVec3), true},
                   {"body/velocity", state.velocity, bodies, 3, sizeof(PackedVec3), true},
                   {"pairs/pairs", d.buffers.pairs().data(), d.last.pairs, 2, sizeof(core::Pair), false}};
  frame.device = device.value();
  return frame;
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
    BROADSIDE_TRY(copy.start(d.buffers, counts, d.is_confirmed_by_level0(), d.stream, d.copy_stream.get()));
  ++d.copies_started;
  return core::Done{};
}

core::Status Pipeline::finish_copy(core::FrameRecord& frame) {
  Impl& d = *impl_;
  if (d.copies_finished == d.copies_started)
    return core::Error{"no copy of a frame is under way", "octree-gpu", "start one first", core::Exit::kInternal};
  FrameCopy& copy = d.copies[d.copies_finished % d.copies.size()];
  if (!copy.has_digest) {
    BROADSIDE_TRY(wait_for_stream(d.stream, "the digest of a frame"));
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

}  // namespace broadside::gpu
