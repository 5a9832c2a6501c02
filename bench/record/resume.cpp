#include "bench/record/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/trace/recover.hpp"

namespace broadside::bench {
namespace {

// Engines whose whole state, where bodies translate, is the bodies' states: a frame depends on the frame before it
// alone. Other engines keep state that no trace holds, such as contact caches and warm-start impulses.
constexpr std::array<std::string_view, 4> kStateIsInBodies{"octree-cpu", "octree-gpu", "hash-cpu", "hash-gpu"};

constexpr const char* kStartAnew = "run without --resume to start at the beginning";

core::Status check_engine(const core::TraceHeader& wanted) {
  const core::Stamp& stamp = wanted.stamp;
  // Engines of bodies that turn keep warm-start impulses, and what orientations lost to rounding.
  const bool turns = wanted.scene.motion == core::Motion::kRigid;
  if (turns || std::find(kStateIsInBodies.begin(), kStateIsInBodies.end(), stamp.engine) == kStateIsInBodies.end())
    return core::Error{"this engine keeps more state than a trace holds, so it cannot go on from one", stamp.engine,
                       kStartAnew};
  if (stamp.settings.find("printed-E8") != std::string::npos)
    return core::Error{"printed-E8 has a data race, so the resumed run would differ from an uninterrupted one",
                       stamp.label(), kStartAnew};
  return core::Done{};
}

core::Status check_stamp(const core::Stamp& found, const core::Stamp& wanted, const std::string& where) {
  const auto refuse = [&where](const char* what, const std::string& has, const std::string& wants) {
    return core::Error{fmt::format("it was recorded with another {} ('{}', this run has '{}')", what, has, wants),
                       where,
                       "use the engine and build that recorded it, or run without --resume to start at the beginning"};
  };
  if (found.scene_digest != wanted.scene_digest)
    return refuse("scene", fmt::format("{} {:016x}", found.scene_name, found.scene_digest),
                  fmt::format("{} {:016x}", wanted.scene_name, wanted.scene_digest));
  if (found.engine != wanted.engine) return refuse("engine", found.engine, wanted.engine);
  if (found.settings != wanted.settings) return refuse("choice of settings", found.settings, wanted.settings);
  if (found.engine_build != wanted.engine_build)
    return refuse("build of the engine", found.engine_build, wanted.engine_build);
  if (found.broadside_build != wanted.broadside_build)
    return refuse("build of Broadside", found.broadside_build, wanted.broadside_build);
  if (found.machine != wanted.machine) return refuse("machine", found.machine, wanted.machine);
  return core::Done{};
}

core::Status check_header(const core::TraceHeader& found, const core::TraceHeader& wanted, const std::string& where) {
  if (core::Status s = check_stamp(found.stamp, wanted.stamp, where); !s) return s;
  if (found.level != core::RecordLevel::kFull || (found.groups & bit(core::Group::kBodies)) == 0U)
    return core::Error{"it was recorded without the bodies' states, so nothing can go on from it", where, kStartAnew};
  const auto steps = [](const core::TraceHeader& h) {
    const std::string windows = windows_of(h);
    return fmt::format("every {} of {}", h.every, windows.empty() ? "all steps" : "steps " + windows);
  };
  if (steps(found) != steps(wanted))
    return core::Error{fmt::format("it recorded other steps ({}; this run {})", steps(found), steps(wanted)), where,
                       "give the same --every and --window, or run without --resume"};
  return core::Done{};
}

core::Result<ResumePoint> point_at(core::TraceReader trace, const CellRequest& request) {
  const std::uint64_t last = trace.frame_count() - 1;
  auto frame = trace.read(last, bit(core::Group::kBodies));
  if (!frame) return frame.error();
  core::Scene scene = *request.scene;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene.bodies[i].position = frame.value().position[i];
    scene.bodies[i].velocity = frame.value().velocity[i];
  }
  if (core::Status s = core::check_scene(scene); !s)
    return core::Error{
        fmt::format("no run can go on from the states of its last frame: {}: {}", s.error().where, s.error().what),
        trace.path().string(), kStartAnew};
  const std::uint64_t step = frame.value().step;
  return ResumePoint{std::move(trace), std::move(scene), step, false};
}

std::filesystem::path with_suffix(std::filesystem::path path, const char* suffix) {
  return path += suffix;
}

}  // namespace

std::string windows_of(const core::TraceHeader& header) {
  const auto note = header.notes.find(kWindowsNote);
  return note == header.notes.end() ? "" : note->second;
}

std::filesystem::path set_aside_path(const CellRequest& request, const core::Stamp& stamp) {
  return request.folder / (trace_file_name(stamp) + ".interrupted");
}

core::Result<std::optional<ResumePoint>> find_resume_point(const CellRequest& request,
                                                           const core::TraceHeader& wanted) {
  const std::filesystem::path whole = request.folder / trace_file_name(wanted.stamp);
  const std::filesystem::path part = with_suffix(whole, ".part");
  const std::filesystem::path aside = set_aside_path(request, wanted.stamp);
  std::optional<core::TraceReader> farthest;
  for (const std::filesystem::path& candidate : {whole, aside, part}) {
    std::error_code ignored;
    if (!std::filesystem::exists(candidate, ignored)) continue;
    auto opened = core::TraceReader::open(candidate);
    if (!opened) {
      if (candidate == part) continue;  // killed before its first frame
      return opened.error();
    }
    core::TraceReader trace = std::move(opened).value();
    if (trace.frame_count() == 0) continue;
    if (!farthest || trace.steps().back() > farthest->steps().back()) farthest = std::move(trace);
  }
  if (!farthest) return std::optional<ResumePoint>();
  if (core::Status s = check_engine(wanted); !s) return s.error();
  if (core::Status s = check_header(farthest->header(), wanted, farthest->path().string()); !s) return s.error();
  const std::filesystem::path chosen = farthest->path();
  auto point = point_at(*std::move(farthest), request);
  if (!point) return point.error();
  point.value().is_complete = chosen == whole && point.value().step == request.frames;
  if (chosen == part) {
    if (core::Status s = core::set_aside(part, aside); !s) return s.error();
  }
  return std::optional(std::move(point).value());
}

}  // namespace broadside::bench
