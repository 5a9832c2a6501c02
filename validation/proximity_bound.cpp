#include "validation/proximity_bound.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/math/quat.hpp"
#include "core/scene/shapes.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"
#include "validation/vertex_tree.hpp"

namespace broadside::validation {
namespace {

// How many confirmed pairs are searched again for each doubling of their number.
constexpr std::uint64_t kPairsPerDoubling = 512;

// One distinct (mesh, orientation).
struct Surface {
  std::vector<core::Vec3> vertices;  // vertices turned by the orientation
  double mean_edge_m = 0.0;
  double covering_radius_m = 0.0;
};

class ProximityBound final : public Validator {
 public:
  explicit ProximityBound(const Subject& subject)
      : header_(subject.header), scene_(header_.scene), is_off_(setting(header_.stamp, "vertex_stage") == "off") {
    if (is_off_) return;
    const core::ShapeTable table = core::build_shapes(scene_);
    surface_of_ = table.shape_of_body;
    surfaces_.resize(table.shapes.size());
    std::vector<bool> is_made(table.shapes.size(), false);
    for (std::uint32_t body = 0; body < scene_.body_count(); ++body) {
      const std::uint32_t s = surface_of_[body];
      if (is_made[s]) continue;
      is_made[s] = true;
      const core::Mesh& mesh = *scene_.meshes[scene_.bodies[body].mesh];
      Surface& surface = surfaces_[s];
      for (const core::Vec3 v : mesh.vertices)
        surface.vertices.push_back(core::rotate(scene_.bodies[body].orientation, v));
      surface.mean_edge_m = table.shapes[s].mean_edge_m;
      surface.covering_radius_m = core::covering_radius_m(mesh);
    }
    for (const Surface& surface : surfaces_) trees_.emplace_back(surface.vertices);
    if (subject.baseline != nullptr && has(*subject.baseline, core::Group::kNarrow)) {
      const core::TraceHeader& base = *subject.baseline;
      baseline_ = base.stamp.label();
      is_fed_by_subject_ = base.driver == header_.stamp.label() || base.driver == header_.stamp.engine;
    }
  }

  void look(const Evidence& evidence) override {
    frame_ = &evidence.frame;
    if (is_off_) {
      if (!frame_->proximity.empty())
        tally_.require(false, "METHOD 3: without the vertex stage there are no proximities",
                       Where::frame(frame_->step, "proximity"));
      return;
    }
    if (frame_->proximity.size() != frame_->confirmed.size()) {
      // Empty lists in all frames are lawful: the vertex stage was off. Our engines say in their settings whether it
      // was.
      const bool was_on = setting(header_.stamp, "vertex_stage") == "on" || confirmed_ > 0;
      if (frame_->proximity.empty() && !was_on) return;
      tally_.require(false, "one proximity per confirmed pair", Where::frame(frame_->step, "proximity"));
      return;
    }
    if (frame_->boxes.size() != scene_.bodies.size() || frame_->detected_position.size() != scene_.bodies.size())
      return;
    for (std::size_t k = 0; k < frame_->confirmed.size(); ++k) {
      judge_record(frame_->confirmed[k], frame_->proximity[k]);
      const std::uint64_t stride = std::max<std::uint64_t>(1, std::bit_floor(confirmed_ / kPairsPerDoubling));
      if (confirmed_++ % stride == 0) search(frame_->confirmed[k], frame_->proximity[k]);
    }
    if (!baseline_.empty() && evidence.baseline != nullptr) judge_surfaces(*evidence.baseline);
  }

  core::Verdict conclude() override {
    std::string notes =
        std::to_string(searched_) + " of " + std::to_string(confirmed_) + " confirmed pairs searched again";
    if (measured_ > 0) {
      notes += ", " + std::to_string(measured_) + " measured by the baseline in " + std::to_string(frames_measured_) +
               " frames";
      if (meeting_ > 0)
        notes += ", of " + std::to_string(meeting_) + " pairs whose surfaces intersect, vertex proximity missed " +
                 std::to_string(missed_) + " (" +
                 number_text(100.0 * static_cast<double>(missed_) / static_cast<double>(meeting_)) + " %, E13)";
    }
    if (elsewhere_ > 0)
      notes += ", " + std::to_string(elsewhere_) + " measured frames not used, because their positions differ";
    core::Verdict verdict =
        tally_.conclude(is_off_ ? "the vertex stage was off" : "no confirmed pair with vertex proximity", notes);
    if (measured_ > 0) verdict.baseline = baseline_;
    return verdict;
  }

 private:
  const Surface& surface(std::uint32_t body) const { return surfaces_[surface_of_[body]]; }

  [[nodiscard]] double theta(core::Pair p) const {
    const double given = scene_.parameters.theta_m;
    return given > 0.0 ? given : 0.5 * (surface(p.i).mean_edge_m + surface(p.j).mean_edge_m);
  }

  // Bound of what rounding the world vertices of both bodies does to a distance.
  [[nodiscard]] double placement(core::Pair p) const {
    double reach = 0.0;
    for (const std::uint32_t body : {p.i, p.j}) {
      const core::Box& box = frame_->boxes[body];
      reach += std::max(largest_component(Vec3d(box.min)), largest_component(Vec3d(box.max)));
    }
    return std::sqrt(3.0) * rounding(1) * reach;
  }

  [[nodiscard]] Where at(core::Pair p, std::string_view field) const {
    return Where::pair(frame_->step, p.i, p.j, field);
  }

  [[nodiscard]] bool is_known(core::Pair p) const { return p.i < scene_.body_count() && p.j < scene_.body_count(); }

  // The witnesses of a touching pair, in the same arithmetic as the engine's vertices.
  void judge_record(core::Pair p, const core::Proximity& proximity) {
    if (!is_known(p)) return;
    if (!proximity.is_touching()) {
      tally_.require(proximity == core::Proximity{},
                     "SCHEMA.md: a pair that does not touch has no vertices and no distance", at(p, "proximity"));
      return;
    }
    const auto& a = surface(p.i).vertices;
    const auto& b = surface(p.j).vertices;
    if (!tally_.require(proximity.vertex_a < a.size() && proximity.vertex_b < b.size(),
                        "witnesses are vertices of the two meshes", at(p, "proximity.vertex")))
      return;
    const Vec3d d = Vec3d(a[proximity.vertex_a]) + Vec3d(frame_->detected_position[p.i]) -
                    (Vec3d(b[proximity.vertex_b]) + Vec3d(frame_->detected_position[p.j]));
    const double recorded = std::sqrt(static_cast<double>(proximity.squared_distance_m2));
    const double limit = placement(p) + rounding(3) * recorded + std::sqrt(3.0 * kSubnormal);
    tally_.check(std::abs(recorded - length(d)), {limit, "m", kPlacement}, at(p, "proximity.squared_distance"));
    tally_.check(recorded, {theta(p) * (1.0 + rounding(2)), "m", "P(8): touching means nearer than theta"},
                 at(p, "proximity.squared_distance"));
  }

  void search(core::Pair p, const core::Proximity& proximity) {
    if (!is_known(p)) return;
    ++searched_;
    const bool touches = proximity.is_touching();
    const double claimed = touches ? std::sqrt(static_cast<double>(proximity.squared_distance_m2)) : theta(p);
    const double nearest =
        trees_[surface_of_[p.i]].nearest(Vec3d(frame_->detected_position[p.i]), trees_[surface_of_[p.j]],
                                         Vec3d(frame_->detected_position[p.j]), claimed);
    tally_.check(claimed - nearest,
                 {placement(p) + rounding(touches ? 3 : 4) * claimed + std::sqrt(3.0 * kSubnormal), "m", kPlacement},
                 at(p, touches ? "proximity: a nearer vertex pair" : "proximity: a vertex pair below theta"));
    if (touches) judge_tie(p, proximity);
  }

  // A vertex where the engine sees it: its two floats added once.
  [[nodiscard]] Vec3d placed(std::uint32_t body, std::uint32_t vertex) const {
    return Vec3d(surface(body).vertices[vertex] + frame_->detected_position[body]);
  }

  // Components that are equal but for their sign give the same distance, however it is computed. Of such vertex pairs
  // the recorded one is the lowest.
  void judge_tie(core::Pair p, const core::Proximity& proximity) {
    if (proximity.vertex_a >= surface(p.i).vertices.size() || proximity.vertex_b >= surface(p.j).vertices.size())
      return;
    const Vec3d told = placed(p.i, proximity.vertex_a) - placed(p.j, proximity.vertex_b);
    bool is_lowest = true;
    trees_[surface_of_[p.i]].visit_within(
        Vec3d(frame_->detected_position[p.i]), trees_[surface_of_[p.j]], Vec3d(frame_->detected_position[p.j]),
        length(told) + placement(p), [&](std::uint32_t a, std::uint32_t b) {
          if (std::pair(a, b) >= std::pair(proximity.vertex_a, proximity.vertex_b)) return;
          const Vec3d d = placed(p.i, a) - placed(p.j, b);
          is_lowest = is_lowest && !(std::abs(d.x) == std::abs(told.x) && std::abs(d.y) == std::abs(told.y) &&
                                     std::abs(d.z) == std::abs(told.z));
        });
    tally_.require(is_lowest, "core/method/proximity.hpp: ties go to the lowest vertex of A, then of B",
                   at(p, "proximity.vertex"));
  }

  void judge_surfaces(const core::FrameRecord& baseline) {
    if (baseline.measured.empty()) return;
    const bool same_place = baseline.detected_position.empty()
                                ? is_fed_by_subject_
                                : baseline.detected_position == frame_->detected_position;
    if (!same_place) {
      ++elsewhere_;
      return;
    }
    ++frames_measured_;
    for (std::size_t k = 0; k < baseline.measured.size() && k < baseline.separations.size(); ++k)
      if (is_known(baseline.measured[k])) judge_separation(baseline.measured[k], baseline.separations[k]);
  }

  void judge_separation(core::Pair p, const core::Separation& separation) {
    ++measured_;
    const auto found = std::lower_bound(frame_->confirmed.begin(), frame_->confirmed.end(), p);
    const bool is_confirmed = found != frame_->confirmed.end() && *found == p;
    const core::Proximity proximity =
        is_confirmed ? frame_->proximity[static_cast<std::size_t>(found - frame_->confirmed.begin())]
                     : core::Proximity{};
    const bool meets = separation.is_touching || separation.distance_m <= 0.0;
    if (meets) {
      ++meeting_;
      if (!proximity.is_touching()) ++missed_;
    }
    if (!is_confirmed) return;
    if (std::isnan(separation.distance_m)) {
      tally_.leave_undecided();
      return;
    }
    const double distance = meets ? 0.0 : separation.distance_m;
    const double cover = surface(p.i).covering_radius_m + surface(p.j).covering_radius_m;
    const double slack = placement(p) + rounding(4) * (distance + theta(p));
    if (!proximity.is_touching()) {
      // Surfaces that overlap have no such bound: a small body inside a large one is far from every vertex.
      if (!meets)
        tally_.check(theta(p) - cover - distance,
                     {slack, "m", "METHOD 3: d_vv >= theta means d >= theta - rho_A - rho_B"}, at(p, "proximity"));
      return;
    }
    const double d_vv = std::sqrt(static_cast<double>(proximity.squared_distance_m2));
    tally_.check(distance - d_vv, {slack, "m", "METHOD 3: d <= d_vv, to the rounding of world vertices"},
                 at(p, "proximity"));
    if (!meets)
      tally_.check(d_vv - distance - cover, {slack, "m", "METHOD 3: d_vv <= d + rho_A + rho_B"}, at(p, "proximity"));
  }

  static constexpr std::string_view kPlacement =
      "sqrt(3) u (W_A + W_B) for rounded world vertices, and the square's rounding";

  const core::TraceHeader& header_;
  const core::Scene& scene_;
  bool is_off_;
  std::vector<std::uint32_t> surface_of_;
  std::vector<Surface> surfaces_;
  std::vector<VertexTree> trees_;
  std::string baseline_;
  bool is_fed_by_subject_ = false;
  const core::FrameRecord* frame_ = nullptr;
  Tally tally_{"proximity-bound", "distances",
               "METHOD 3: d <= d_vv <= d + rho_A + rho_B, nearest vertices below theta"};
  std::uint64_t searched_ = 0;
  std::uint64_t confirmed_ = 0;
  std::uint64_t measured_ = 0;
  std::uint64_t frames_measured_ = 0;
  std::uint64_t meeting_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t elsewhere_ = 0;
};

std::string why_not_proximity_bound(const Subject& subject) {
  constexpr std::uint32_t kBoth = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
  if (std::string text = lacking(subject.header, kBoth); !text.empty()) return text;
  return has(subject.header, core::Group::kDetectedOrientation)
             ? "the scene's bodies turn, and their contacts are between surfaces, not vertices"
             : "";
}

}  // namespace

ValidatorRow proximity_bound_row() {
  constexpr std::uint32_t kRead = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
  return {
      "proximity-bound",
      "vertex proximity is the nearest pair below theta, and d <= d_vv <= d + rho_A + rho_B against the surfaces",
      "theta tested on squared distance; a missed vertex",
      kRead,
      core::bit(core::Group::kNarrow) | core::bit(core::Group::kDetection),
      why_not_proximity_bound,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<ProximityBound>(subject); }};
}

}  // namespace broadside::validation
