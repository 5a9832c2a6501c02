#include "bench/shrink/engine_stream.hpp"

#include <algorithm>
#include <utility>

#include "bench/cell/cell_request.hpp"
#include "bench/engines.hpp"
#include "bench/record/near_pairs.hpp"
#include "core/engine/chosen_by_scene.hpp"

namespace broadside::bench {
namespace {

using core::bit;
using core::Group;

constexpr std::string_view kStreamDriver = "octree-cpu";

std::vector<std::uint8_t> flags_of_statics(const core::Scene& scene) {
  std::vector<std::uint8_t> flags;
  for (const core::Body& body : scene.bodies) flags.push_back(body.inverse_mass > 0.0F ? 0 : 1);
  return flags;
}

}  // namespace

void set_states(std::vector<core::Body>& bodies, const core::FrameRecord& frame) {
  for (std::size_t i = 0; i < std::min(bodies.size(), frame.position.size()); ++i) {
    bodies[i].position = frame.position[i];
    bodies[i].velocity = frame.velocity[i];
    bodies[i].orientation = frame.orientation[i];
    bodies[i].angular_velocity = frame.angular_velocity[i];
  }
}

core::Result<std::unique_ptr<EngineStream>> EngineStream::start(const core::Scene& scene, const CellSpec& spec) {
  if (const std::string reason = spec.row->absent != nullptr ? spec.row->absent() : ""; !reason.empty())
    return core::Error{"not measured: " + reason, std::string(spec.row->id), "use another engine",
                       core::Exit::kMissing};
  auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
  if (!settings) return settings.error();
  auto created = spec.row->create(settings.value());
  if (!created) return created.error();
  std::unique_ptr<EngineStream> stream(new EngineStream(scene));
  stream->engine_ = std::move(created).value();
  if (core::Status s = stream->load(); !s) return s.error();
  return stream;
}

core::Status EngineStream::load() {
  header_.scene = scene_;
  header_.stamp = stamp_of(scene_, engine_);
  header_.declaration = core::declaration_of(engine_, scene_);
  for (std::uint64_t step = 1; step <= scene_.frames; ++step) steps_.push_back(step);
  if (engine_.dynamics) {
    header_.groups = core::groups_of(*engine_.dynamics, scene_);
    if (const std::string note = core::digest_note_of(*engine_.dynamics, scene_); !note.empty())
      header_.notes["digest"] = note;
    return engine_.dynamics->load(scene_);
  }
  auto driver = start(scene_, {find_engine(kStreamDriver).value(), {}});
  if (!driver) return driver.error();
  driver_ = std::move(driver).value();
  header_.driver = driver_->header_.stamp.label();
  if (!engine_.broad_phase) {
    header_.groups = bit(Group::kNarrow) | bit(Group::kDetection);
    return engine_.narrow_phase->load(scene_);
  }
  header_.groups = bit(Group::kDetection) | bit(Group::kPairs);
  header_.broad_is_exact = engine_.broad_phase->traits().exact;
  header_.broad_margin_m = engine_.broad_phase->traits().margin_m;
  return core::Done{};
}

validation::FrameSource EngineStream::source() {
  return {header_, steps_, [this](std::uint64_t, std::uint32_t) { return next(); }};
}

core::Result<core::FrameRecord> EngineStream::next() {
  core::FrameRecord frame;
  if (engine_.dynamics) {
    if (core::Status s = engine_.dynamics->step(scene_.dt_s); !s) return s.error();
    if (core::Status s = engine_.dynamics->read_back(frame, core::RecordLevel::kFull); !s) return s.error();
    set_states(bodies_, frame);
    return frame;
  }
  auto fed = driver_->next();
  if (!fed) return fed.error();
  bodies_ = driver_->bodies_;
  frame = std::move(fed).value();
  const core::Status status = engine_.broad_phase ? find_pairs(frame) : measure(frame);
  if (!status) return status.error();
  return frame;
}

core::Status EngineStream::find_pairs(core::FrameRecord& frame) {
  core::BroadPhase& broad = *engine_.broad_phase;
  core::Status status = is_loaded_ ? broad.update(frame.boxes) : broad.load(frame.boxes, flags_of_statics(scene_));
  is_loaded_ = true;
  if (status.ok()) status = broad.find();
  if (!status) return status;
  auto found = broad.read_back();
  if (!found) return found.error();
  frame.pairs = std::move(found.value().pairs);
  frame.pairs_demanded = found.value().demanded;
  frame.pairs_raw = found.value().raw;
  return core::Done{};
}

core::Status EngineStream::measure(core::FrameRecord& frame) {
  frame.measured = NearPairs(scene_).of(frame);
  std::vector<core::Pose> poses;
  for (std::size_t i = 0; i < frame.detected_position.size(); ++i)
    poses.push_back({frame.detected_position[i], scene_.bodies[i].orientation});
  if (core::Status s = engine_.narrow_phase->measure(frame.measured, poses); !s) return s;
  auto separations = engine_.narrow_phase->read_back();
  if (!separations) return separations.error();
  frame.separations = std::move(separations).value();
  return core::Done{};
}

}  // namespace broadside::bench
