#include "bench/record/playback_of_trace.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/scene/body_octree.hpp"
#include "core/scene/shapes.hpp"
#include "core/trace/trace_reader.hpp"
#include "reports/wording.hpp"

namespace broadside::bench {
namespace {

using core::Group;
using reports::Playback;

constexpr std::uint64_t kMostBytes = 700'000;  // for all playbacks of a report; with the script about 3 MB
constexpr std::size_t kMostPlaybacks = 4;
constexpr std::size_t kMostBodies = 20'000;     // 120 kB a frame
constexpr std::size_t kMostTriangles = 12'000;  // of one mesh; larger ones are shown as their level-2 boxes
constexpr std::uint64_t kAround = 8;            // recorded frames before and after a place
constexpr std::size_t kMostMarks = 12;
constexpr std::uint64_t kSpread = 240;  // frames spread over the whole run, where they fit

core::Vec3 up_of(const core::Scene& scene) {
  const float g = core::length(scene.gravity_m_s2);
  return g > 0.0F ? (-1.0F / g) * scene.gravity_m_s2 : core::Vec3{0.0F, 1.0F, 0.0F};
}

// The octree of the shape as engines use it, after the body's constant orientation.
reports::PlaybackShape shape_of(const core::Shape& shape, const core::Mesh& mesh) {
  reports::PlaybackShape out;
  for (int level = 0; level < core::kBodyOctreeLevels; ++level) {
    auto& boxes = out.levels.emplace_back();
    const auto l = static_cast<std::size_t>(level);
    for (int k = 0; k < core::kLevelSize[l]; ++k) {
      const core::Box& box =
          shape.octree.boxes[static_cast<std::size_t>(core::kLevelOffset[l]) + static_cast<std::size_t>(k)];
      if (!core::is_empty(box)) boxes.push_back(box);
    }
  }
  if (mesh.triangles.size() > kMostTriangles || mesh.vertices.size() > 65'535) return out;
  out.vertices.resize(mesh.vertices.size());
  for (std::size_t k = 0; k < shape.octree.sorted_vertices.size(); ++k)
    out.vertices[shape.octree.sorted_indices[k]] = shape.octree.sorted_vertices[k];
  out.triangles = mesh.triangles;
  return out;
}

// The middle of the overlap of the two boxes at the moment the contact was applied; for a contact with a face of the
// domain, the middle of the box's side.
core::Vec3 point_of(const core::Contact& c, const std::vector<core::Box>& local) {
  core::Box box = core::translated(local[c.a], c.pre_a.x);
  core::Vec3 point = 0.5F * (box.min + box.max);
  if (core::is_face(c.b)) {
    for (int axis = 0; axis < 3; ++axis)
      if (c.normal[axis] != 0.0F) point[axis] = c.normal[axis] > 0.0F ? box.min[axis] : box.max[axis];
    return point;
  }
  const core::Box other = core::translated(local[c.b], c.pre_b.x);
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = 0.5F * (std::max(box.min[axis], other.min[axis]) + std::min(box.max[axis], other.max[axis]));
  return point;
}

// The rotation from `first` to `now`: now times the inverse of first, both unit quaternions.
core::Quat turn_from(core::Quat first, core::Quat now) {
  const core::Quat f{first.w, -first.x, -first.y, -first.z};
  return {now.w * f.w - now.x * f.x - now.y * f.y - now.z * f.z, now.w * f.x + now.x * f.w + now.y * f.z - now.z * f.y,
          now.w * f.y - now.x * f.z + now.y * f.w + now.z * f.x, now.w * f.z + now.x * f.y - now.y * f.x + now.z * f.w};
}

class Taker {
 public:
  Taker(const core::TraceReader& trace, std::vector<reports::PlaybackMark> marks) : trace_(trace) {
    const core::Scene& scene = trace.header().scene;
    playback_.stamp = trace.header().stamp;
    playback_.trace_file = trace.path().filename().string();
    playback_.domain = scene.domain;
    playback_.up = up_of(scene);
    playback_.dt_s = static_cast<double>(scene.dt_s);
    playback_.last_step = trace.steps().back();
    playback_.marks = std::move(marks);
    const core::ShapeTable table = core::build_shapes(scene);
    playback_.shape_of_body.assign(table.shape_of_body.begin(), table.shape_of_body.end());
    for (const core::Shape& shape : table.shapes)
      playback_.shapes.push_back(shape_of(shape, *scene.meshes[shape.mesh]));
    for (const std::uint32_t s : playback_.shape_of_body) local_.push_back(playback_.shapes[s].levels[0][0]);
  }

  // Empty when the trace turns out to be damaged.
  Playback take(std::uint64_t most_bytes) {
    const std::uint64_t fixed_bytes = reports::playback_bytes(playback_);
    const std::vector<std::uint64_t> indices = wanted(most_bytes > fixed_bytes ? most_bytes - fixed_bytes : 0);
    for (const std::uint64_t k : indices)
      if (auto frame = frame_at(k); frame) playback_.frames.push_back(*std::move(frame));
    return std::move(playback_);
  }

 private:
  // The poses that collision detection saw, where the trace has all of them; else those at the end of the step.
  void take_poses(core::FrameRecord& record, reports::PlaybackFrame& frame) const {
    const std::vector<core::Body>& bodies = trace_.header().scene.bodies;
    const bool turns = trace_.header().scene.motion == core::Motion::kRigid;
    const bool has_detection =
        !record.detected_position.empty() && (!turns || record.detected_orientation.size() == bodies.size());
    frame.position = std::move(has_detection ? record.detected_position : record.position);
    const std::vector<core::Quat>& now = has_detection ? record.detected_orientation : record.orientation;
    if (!turns || now.size() != bodies.size()) return;
    for (std::size_t k = 0; k < bodies.size(); ++k) frame.turn.push_back(turn_from(bodies[k].orientation, now[k]));
  }

  std::optional<reports::PlaybackFrame> frame_at(std::uint64_t k) const {
    const std::uint32_t groups = bit(Group::kBodies) | bit(Group::kDetection) | bit(Group::kDetectedOrientation) |
                                 bit(Group::kPairs) | bit(Group::kConfirmed) | bit(Group::kContacts) |
                                 bit(Group::kPoints);
    auto read = trace_.read(k, groups & trace_.header().groups);
    if (!read) return std::nullopt;
    core::FrameRecord& record = read.value();
    reports::PlaybackFrame frame;
    frame.step = record.step;
    take_poses(record, frame);
    frame.pairs = std::move(record.pairs.empty() ? record.confirmed : record.pairs);
    for (const core::Contact& c : record.contacts)
      frame.contacts.push_back({c.a, c.b, point_of(c, local_), c.normal, c.depth_m});
    for (const core::ContactPoint& p : record.points)
      frame.contacts.push_back({p.a, p.b, p.point, p.normal, std::max(0.0F, -p.gap_m)});
    return frame;
  }

  // Indices of the frames to show: first those around each mark, then as many others as the bytes allow.
  std::vector<std::uint64_t> wanted(std::uint64_t bytes) {
    const std::vector<std::uint64_t>& steps = trace_.steps();
    const std::uint64_t count = steps.size();
    std::set<std::uint64_t> chosen;
    // The cost of a frame is taken from the fullest of a sample.
    std::uint64_t each = 1;
    for (const std::uint64_t k : {std::uint64_t{0}, count / 2, count - 1})
      if (auto frame = frame_at(k); frame) {
        Playback one;
        one.frames.push_back(*std::move(frame));
        each = std::max(each, reports::playback_bytes(one));
      }
    const std::uint64_t most = std::max<std::uint64_t>(1, bytes / each);
    for (std::uint64_t reach = 0; reach <= kAround; ++reach) {
      for (const reports::PlaybackMark& mark : playback_.marks) {
        if (mark.step < 0) continue;
        const auto at = static_cast<std::uint64_t>(
            std::lower_bound(steps.begin(), steps.end(), static_cast<std::uint64_t>(mark.step)) - steps.begin());
        if (at >= reach && at - reach < count && chosen.size() < most) chosen.insert(at - reach);
        if (at + reach < count && chosen.size() < most) chosen.insert(at + reach);
      }
    }
    const std::uint64_t more = std::min({most - std::min<std::uint64_t>(most, chosen.size()), kSpread, count});
    for (std::uint64_t k = 0; k < more; ++k) chosen.insert(more > 1 ? k * (count - 1) / (more - 1) : count - 1);
    return {chosen.begin(), chosen.end()};
  }

  const core::TraceReader& trace_;
  Playback playback_;
  std::vector<core::Box> local_;
};

std::vector<reports::PlaybackMark> marks_of(const core::RunRows& rows, const core::Cell& cell) {
  std::vector<reports::PlaybackMark> marks;
  for (const core::Outcome outcome : {core::Outcome::kFail, core::Outcome::kInconclusive}) {
    for (const core::CellVerdicts& judged : rows.verdicts) {
      if (judged.trace_file != cell.trace_file || judged.stamp.scene_digest != cell.stamp.scene_digest) continue;
      for (const core::Verdict& v : judged.verdicts) {
        if (v.outcome != outcome || (v.worst.step < 0 && v.worst.bodies.empty()) || marks.size() >= kMostMarks)
          continue;
        const std::string word(core::outcome_word(v.outcome));
        marks.push_back({word + ": " + v.validator + " at " + reports::place_text(v.worst), v.validator, v.baseline,
                         v.worst.step, v.worst.bodies});
      }
    }
  }
  return marks;
}

struct Choice {
  const core::Cell* cell;
  std::vector<reports::PlaybackMark> marks;
};

// The runs that did not pass, and then one run per scene to look at; or every run, in the order of the rows.
std::vector<Choice> choices(const core::RunRows& rows, bool every_run) {
  std::vector<Choice> chosen;
  for (const core::Cell& cell : rows.cells) {
    if (cell.trace_file.empty() || cell.state != core::CellState::kRecorded) continue;
    std::vector<reports::PlaybackMark> marks = marks_of(rows, cell);
    const bool is_first_of_scene = std::none_of(chosen.begin(), chosen.end(), [&](const Choice& c) {
      return c.cell->stamp.scene_digest == cell.stamp.scene_digest;
    });
    if (every_run || !marks.empty() || is_first_of_scene) chosen.push_back({&cell, std::move(marks)});
  }
  if (every_run) return chosen;
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Choice& a, const Choice& b) { return a.marks.empty() < b.marks.empty(); });
  return chosen;
}

}  // namespace

PlaybackShare share_of(std::size_t folders) {
  return {kMostBytes / folders, std::max<std::size_t>(1, kMostPlaybacks / folders), false};
}

std::vector<Playback> playbacks_of(const core::RunRows& rows, const std::filesystem::path& folder,
                                   const PlaybackShare& share) {
  std::vector<Playback> playbacks;
  std::vector<Choice> chosen = choices(rows, share.every_run);
  std::uint64_t left = share.most_bytes;
  const std::size_t most = share.most_runs;
  for (std::size_t k = 0; k < chosen.size() && playbacks.size() < most; ++k) {
    auto trace = core::TraceReader::open(folder / chosen[k].cell->trace_file);
    if (!trace || trace.value().steps().empty()) continue;
    const core::TraceHeader& header = trace.value().header();
    const bool has_poses = (header.groups & (bit(Group::kDetection) | bit(Group::kBodies))) != 0;
    if (!has_poses || header.scene.bodies.size() > kMostBodies) continue;
    const std::uint64_t to_come = std::min(most - playbacks.size(), chosen.size() - k);
    Playback playback = Taker(trace.value(), std::move(chosen[k].marks)).take(left / to_come);
    if (playback.frames.empty()) continue;
    left -= std::min(left, reports::playback_bytes(playback));
    playbacks.push_back(std::move(playback));
  }
  return playbacks;
}

std::vector<reports::FrameSeries> penetration_of(const core::RunRows& rows, const std::filesystem::path& folder) {
  std::vector<reports::FrameSeries> all;
  for (const core::Cell& cell : rows.cells) {
    if (cell.trace_file.empty() || cell.state != core::CellState::kRecorded) continue;
    auto trace = core::TraceReader::open(folder / cell.trace_file);
    if (!trace) continue;
    auto statistics = trace.value().statistics();
    if (!statistics || statistics.value().empty()) continue;
    reports::FrameSeries series{.stamp = cell.stamp, .subject = "penetration", .unit = "m"};
    series.columns = {{"mean depth", {}}, {"largest depth", {}}};
    for (const core::PenetrationStatistics& row : statistics.value()) {
      series.steps.push_back(row.last_step);
      series.columns[0].values.push_back(row.mean_depth_m);
      series.columns[1].values.push_back(row.largest_depth_m);
    }
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace broadside::bench
