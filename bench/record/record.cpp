#include "bench/record/record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "bench/cell/equivalence.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/record/frame_taker.hpp"
#include "bench/record/near_pairs.hpp"
#include "bench/record/recording.hpp"
#include "bench/record/resume.hpp"
#include "core/engine/chosen_by_scene.hpp"
#include "core/engine/work_counting.hpp"
#include "core/scene/shapes.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {
namespace {

using core::Group;

core::TraceHeader header_for(const CellRequest& request, const core::Engine& engine) {
  core::TraceHeader header;
  header.stamp = stamp_of(*request.scene, engine);
  header.declaration = core::declaration_of(engine, *request.scene);
  header.scene = *request.scene;
  header.level = request.level;
  header.every = request.selection.every;
  if (!request.selection.windows.empty()) header.notes[kWindowsNote] = request.selection.windows_text();
  header.notes["command"] = fmt::format("broadside run {} --engine '{}' --frames {}", request.source.spec,
                                        header.stamp.label(), request.frames);
  for (const auto& mesh : request.scene->meshes)
    header.notes["mesh " + mesh->name] = mesh->source + (mesh->is_stand_in ? " (STAND-IN)" : "");
  const core::ShapeTable table = core::build_shapes(*request.scene);
  for (const core::Shape& shape : table.shapes)
    header.notes["theta_m " + request.scene->meshes[shape.mesh]->name] =
        fmt::format("{}", core::pair_theta_m(request.scene->parameters, shape, shape));
  core::add_notes(equivalence_of(engine, *request.scene), header.notes);
  return header;
}

core::Status add_taken(core::Result<std::optional<core::FrameRecord>> taken, Recording& recording) {
  if (!taken) return taken.error();
  if (!taken.value()) return core::Done{};
  return recording.add(*std::move(taken).value());
}

void tell_resume(const core::Stamp& stamp, const std::optional<ResumePoint>& point, std::uint64_t frames) {
  if (!point)
    fmt::print(stderr, "{}: no trace to resume from, so it starts at the beginning\n", stamp.label());
  else if (point->is_complete)
    fmt::print(stderr, "{}: its trace is complete\n", stamp.label());
  else
    fmt::print(stderr, "{}: goes on after step {} of {}\n", stamp.label(), point->step, frames);
}

void note_resume(core::TraceHeader& header, const ResumePoint& point) {
  const auto& notes = point.trace.header().notes;
  const auto earlier = notes.find("resumed");
  header.notes["resumed"] =
      (earlier == notes.end() ? "after step " : earlier->second + ", ") + std::to_string(point.step);
}

// The cell of a trace that already has all frames.
core::Cell complete_cell(const ResumePoint& point) {
  core::Cell cell;
  cell.stamp = point.trace.header().stamp;
  cell.state = core::CellState::kRecorded;
  cell.trace_file = point.trace.path().filename().string();
  cell.frames = point.trace.frame_count();
  cell.digests[point.step] = point.trace.digests().back();
  cell.notes = point.trace.header().notes;
  return cell;
}

// Only engines whose counting takes time offer this capability. A recording of digests alone is meant to be cheap, so
// there nothing is counted.
template <typename Capability>
void ask_for_counts(const CellRequest& request, Capability& capability) {
  auto* counts = dynamic_cast<core::CountsWork*>(&capability);
  if (counts != nullptr && request.level == core::RecordLevel::kFull) counts->count_work();
}

core::Status copy_frames(const core::TraceReader& trace, Recording& recording) {
  for (std::uint64_t k = 0; k < trace.frame_count(); ++k) {
    auto frame = trace.read(k, trace.header().groups);
    if (!frame) return frame.error();
    if (core::Status s = recording.add(std::move(frame).value()); !s) return s;
  }
  return core::Done{};
}

core::Result<core::Cell> record_dynamics(const CellRequest& request, core::Engine& engine) {
  core::Dynamics& dynamics = *engine.dynamics;
  core::TraceHeader header = header_for(request, engine);
  header.groups = request.level == core::RecordLevel::kFull ? core::groups_of(dynamics, *request.scene) : 0;
  if (const std::string note = core::digest_note_of(dynamics, *request.scene); !note.empty())
    header.notes["digest"] = note;
  std::optional<ResumePoint> point;
  if (request.resume) {
    auto found = find_resume_point(request, header);
    if (!found) return found.error();
    point = std::move(found).value();
    tell_resume(header.stamp, point, request.frames);
    if (point && point->is_complete) return complete_cell(*point);
    if (point) note_resume(header, *point);
  }
  const std::uint64_t steps_before = point ? point->step : 0;
  if (!point) ask_for_counts(request, dynamics);
  if (core::Status s = dynamics.load(point ? point->scene : *request.scene); !s) return s.error();
  const core::Stamp stamp = header.stamp;
  auto started = Recording::start(request, std::move(header), request.frames);
  if (!started) return started.error();
  Recording& recording = started.value();
  if (point) {
    if (core::Status s = copy_frames(point->trace, recording); !s) return s.error();
  }
  FrameTaker taker(dynamics, request.level, steps_before, request.scene->dt_s);
  for (std::uint64_t step = steps_before + 1; step <= request.frames; ++step) {
    if (is_interrupted()) {
      if (core::Status s = add_taken(taker.rest(), recording); !s) return s.error();
      return recording.interrupted();
    }
    if (core::Status s = dynamics.step(request.scene->dt_s); !s) return recording.failed(s.error());
    // The last frame is always recorded, because timed runs are compared with its digest.
    if (recording.is_due(step) || step == request.frames) {
      auto taken = taker.take();
      if (!taken) return recording.failed(taken.error());
      if (core::Status s = add_taken(std::move(taken), recording); !s) return s.error();
    }
    recording.note_progress(step);
  }
  auto last = taker.rest();
  if (!last) return recording.failed(last.error());
  if (core::Status s = add_taken(std::move(last), recording); !s) return s.error();
  // In a run that resumed from a trace, the engine counted only a part of the work, so nothing is noted.
  if (!point) recording.note_work(dynamics.counters());
  auto cell = recording.finish();
  std::error_code ignored;
  if (cell && point) std::filesystem::remove(set_aside_path(request, stamp), ignored);
  return cell;
}

core::Error no_feed(const CellRequest& request) {
  return {"the trace has no boxes and poses at detection to feed an engine with", request.driver_trace.string(),
          "record octree-cpu with --record full"};
}

core::Result<core::TraceReader> open_driver(const CellRequest& request, std::uint32_t groups) {
  auto driver = core::TraceReader::open(request.driver_trace);
  if (!driver) return driver.error();
  const core::TraceHeader& header = driver.value().header();
  if ((header.groups & groups) != groups) return no_feed(request);
  if (header.stamp.scene_digest != core::scene_digest(*request.scene))
    return core::Error{"the trace is of another scene", request.driver_trace.string(), "record the driver again"};
  return driver;
}

std::vector<std::uint8_t> static_flags(const core::Scene& scene) {
  std::vector<std::uint8_t> flags;
  for (const core::Body& body : scene.bodies) flags.push_back(body.inverse_mass > 0.0F ? 0 : 1);
  return flags;
}

// Runs the broad phase on the boxes that the driver's broad phase saw, frame by frame.
core::Result<core::Cell> record_broad(const CellRequest& request, core::Engine& engine) {
  auto opened = open_driver(request, bit(Group::kDetection));
  if (!opened) return opened.error();
  const core::TraceReader& driver = opened.value();
  core::BroadPhase& broad = *engine.broad_phase;
  core::TraceHeader header = header_for(request, engine);
  ask_for_counts(request, broad);
  header.groups = request.level == core::RecordLevel::kFull ? bit(Group::kDetection) | bit(Group::kPairs) : 0;
  header.driver = driver.header().stamp.label();
  header.broad_is_exact = broad.traits().exact;
  header.broad_margin_m = broad.traits().margin_m;
  auto started = Recording::start(request, std::move(header), driver.frame_count());
  if (!started) return started.error();
  Recording& recording = started.value();
  const std::vector<std::uint8_t> is_static = static_flags(*request.scene);

  for (std::uint64_t k = 0; k < driver.frame_count(); ++k) {
    if (is_interrupted()) return recording.interrupted();
    auto read = driver.read(k, bit(Group::kDetection));
    if (!read) return read.error();
    core::FrameRecord frame = std::move(read).value();
    core::Status status = k == 0 ? broad.load(frame.boxes, is_static) : broad.update(frame.boxes);
    if (status.ok()) status = broad.find();
    if (!status) return recording.failed(status.error());
    auto found = broad.read_back();
    if (!found) return recording.failed(found.error());
    frame.pairs = std::move(found.value().pairs);
    frame.pairs_demanded = found.value().demanded;
    frame.pairs_raw = found.value().raw;
    frame.digest = core::pair_digest(frame.pairs);
    if (core::Status s = recording.add(std::move(frame)); !s) return s.error();
    recording.note_progress(k + 1);
  }
  recording.note_work(broad.counters());
  return recording.finish();
}

// Measures separations in a sample of frames, at the poses of detection. Measured are the pairs that the driver
// confirmed and pairs that are near (bench/record/near_pairs.hpp); where the driver itself measured pairs, those.
core::Result<core::Cell> record_narrow(const CellRequest& request, core::Engine& engine) {
  auto opened = open_driver(request, bit(Group::kDetection));
  if (!opened) return opened.error();
  const core::TraceReader& driver = opened.value();
  const bool repeats = (driver.header().groups & bit(Group::kNarrow)) != 0;
  const std::uint32_t groups = bit(Group::kDetection) | bit(repeats ? Group::kNarrow : Group::kConfirmed);
  if ((driver.header().groups & groups) != groups) return no_feed(request);
  core::NarrowPhase& narrow = *engine.narrow_phase;
  core::TraceHeader header = header_for(request, engine);
  header.groups = request.level == core::RecordLevel::kFull ? bit(Group::kNarrow) | bit(Group::kDetection) : 0;
  header.driver = driver.header().stamp.label();
  header.every = request.narrow_every;
  header.notes["frames measured"] = fmt::format("every {}th frame of {}", request.narrow_every, driver.frame_count());
  header.notes["pairs measured"] =
      repeats ? "those that the driver measured" : "confirmed by the driver, or boxes within 2 theta";
  if (core::Status s = narrow.load(*request.scene); !s) return s.error();
  CellRequest sampled = request;
  sampled.selection = {};
  auto started = Recording::start(sampled, std::move(header), driver.frame_count());
  if (!started) return started.error();
  Recording& recording = started.value();

  NearPairs near(*request.scene);
  for (std::uint64_t k = 0; k < driver.frame_count(); ++k) {
    if (driver.steps()[k] % request.narrow_every != 0) continue;
    if (is_interrupted()) return recording.interrupted();
    auto read = driver.read(k, groups);
    if (!read) return read.error();
    core::FrameRecord frame = std::move(read).value();
    if (!repeats) frame.measured = near.of(frame);
    std::vector<core::Pose> poses;
    for (std::size_t i = 0; i < frame.detected_position.size(); ++i)
      poses.push_back({frame.detected_position[i], request.scene->bodies[i].orientation});
    if (core::Status s = narrow.measure(frame.measured, poses); !s) return recording.failed(s.error());
    auto separations = narrow.read_back();
    if (!separations) return recording.failed(separations.error());
    frame.separations = std::move(separations).value();
    frame.digest = separation_digest(frame);
    if (core::Status s = recording.add(std::move(frame)); !s) return s.error();
    recording.note_progress(k + 1);
  }
  return recording.finish();
}

core::Result<core::Cell> record_as(const CellRequest& request, core::Engine& engine, std::string_view capability) {
  const auto is_asked = [capability](std::string_view name) { return capability.empty() || capability == name; };
  if (engine.dynamics && is_asked("dynamics")) return record_dynamics(request, engine);
  if (engine.broad_phase && is_asked("broad")) return record_broad(request, engine);
  if (engine.narrow_phase && is_asked("narrow")) return record_narrow(request, engine);
  return core::Error{"it does not offer the capability asked for: " + std::string(capability), engine.id,
                     "see 'broadside list engines'"};
}

}  // namespace

core::Result<core::Cell> record_cell(const CellRequest& request, std::string_view capability) {
  auto settings = core::Settings::parse(request.row->id, request.row->settings, request.settings);
  if (!settings) return settings.error();
  auto created = request.row->create(settings.value());
  if (!created) return created.error();
  core::Engine& engine = created.value();
  auto cell = record_as(request, engine, capability);
  if (cell.ok() && engine.defects) core::add_notes(engine.defects(), cell.value().notes);
  return cell;
}

}  // namespace broadside::bench
