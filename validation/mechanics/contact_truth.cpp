#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "validation/mechanics/detection_pose.hpp"
#include "validation/mechanics/meeting_within.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/oriented_box.hpp"
#include "validation/mechanics/ways_within.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class ContactTruth final : public Validator {
 public:
  explicit ContactTruth(const Subject& subject)
      : header_(subject.header),
        shapes_(header_.scene),
        margin_(header_.declaration.number("contact_margin_m")),
        has_substeps_(header_.declaration.number("substeps") > 1.0) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    frame_ = &evidence.frame;
    finds_within_ = finds_within(header_, *frame_);
    place_bodies(m);
    sort_points();
    if (finds_within_) ways_.read(m, frame_->points);
    if (has_substeps_) meetings_.read(m, header_.scene, frame_->points);
    for (const core::Pair pair : m.near)
      if (is_known(m, pair.i) && is_known(m, pair.j)) judge_pair(m, pair);
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i)
      if (m.facts[i].is_dynamic && is_known(m, i)) judge_faces(m, i);
    for (std::size_t k = 0; k < sorted_.size(); ++k)
      if (k == 0 || key_of(sorted_[k - 1]) != key_of(sorted_[k])) judge_distant(m, sorted_[k]);
  }

  core::Verdict conclude() override {
    return tally_.conclude("no two bodies with convex shapes came near each other",
                           "deepest overlap without a point was at most " + number_text(deepest_) + " m");
  }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  // Of points in the order of sorted_: those of two bodies lie together.
  using Points = std::span<const std::uint32_t>;

  [[nodiscard]] const core::ContactPoint& point(std::uint32_t index) const { return frame_->points[index]; }
  // The lower body first.
  [[nodiscard]] Key key_of(std::uint32_t index) const { return std::minmax(point(index).a, point(index).b); }

  void place_bodies(const Motion& m) {
    poses_.resize(m.bodies.size());
    boxes_.resize(m.bodies.size());
    for (std::size_t i = 0; i < m.bodies.size(); ++i) {
      poses_[i] = detection_pose(header_, *frame_, m, i);
      if (poses_[i]) boxes_[i] = oriented_box(m.facts[i], poses_[i]->origin, matrix_of(poses_[i]->q));
    }
  }

  void sort_points() {
    sorted_.resize(frame_->points.size());
    std::iota(sorted_.begin(), sorted_.end(), 0U);
    std::sort(sorted_.begin(), sorted_.end(),
              [&](std::uint32_t p, std::uint32_t q) { return std::pair(key_of(p), p) < std::pair(key_of(q), q); });
  }

  [[nodiscard]] Points points_of(std::uint32_t a, std::uint32_t b) const {
    const Key key = std::minmax(a, b);
    const auto first = std::lower_bound(sorted_.begin(), sorted_.end(), key,
                                        [&](std::uint32_t p, const Key& k) { return key_of(p) < k; });
    auto last = first;
    while (last != sorted_.end() && key_of(*last) == key) ++last;
    return {first, last};
  }

  [[nodiscard]] bool is_known(const Motion& m, std::uint32_t i) const {
    return poses_[i].has_value() && shapes_.knows(m.facts[i].mesh);
  }

  // Within this distance a contact may be reported or not: slop, margin, how far the two can approach in a step, and
  // float32. A contact that was found within the step has the normal of that moment, so the bodies' whole ways count.
  [[nodiscard]] double band(const Motion& m, std::uint32_t a, std::uint32_t b) const {
    const auto way_m = [&](std::uint32_t i) {
      if (core::is_face(i)) return 0.0;
      if (finds_within_) return ways_.way_m(i, m.facts[i].reach_m);
      const BodyState& s = m.bodies[i].before;
      return m.h * (length(s.v) + length(s.w) * m.facts[i].reach_m);
    };
    const double size = m.facts[a].reach_m + length(m.bodies[a].after.x);
    return header_.scene.parameters.delta_m + margin_ + way_m(a) + way_m(b) + m.h * m.h * m.strongest_pull +
           rounding(16) * size;
  }

  // The exact distance of one pair, measured when something asks for it.
  class Truth {
   public:
    Truth(const ContactTruth& law, const Motion& m, core::Pair pair) : law_(law), m_(m), pair_(pair) {}
    [[nodiscard]] exact::ConvexCore placed(std::uint32_t i) const {
      return law_.shapes_.placed(m_.facts[i].mesh, law_.poses_[i]->origin, law_.poses_[i]->q);
    }
    const exact::SignedDistance& distance() {
      if (!distance_) distance_ = exact::signed_distance(placed(pair_.i), placed(pair_.j));
      return *distance_;
    }
    double depth() { return std::max(0.0, -distance().distance_m); }

   private:
    const ContactTruth& law_;
    const Motion& m_;
    core::Pair pair_;
    std::optional<exact::SignedDistance> distance_;
  };

  void judge_pair(const Motion& m, core::Pair pair) {
    const double allowed = band(m, pair.i, pair.j);
    const Points points = points_of(pair.i, pair.j);
    const double bound = overlap_bound(boxes_[pair.i], boxes_[pair.j]);
    Truth truth(*this, m, pair);
    const auto worked = [&] {
      return "the exact distance is " + number_text(truth.distance().distance_m) + " m along " +
             vector_text(to_vec3d(truth.distance().normal)) + ", and " +
             (points.empty() ? std::string("no point is reported") : std::to_string(points.size()) + " points are");
    };
    if (points.empty()) {
      // The bound must not exceed the deepest overlap so far either, because the verdict tells the deepest one.
      if (bound <= deepest_ && tally_.check_bound(std::max(0.0, bound), allowed)) return;
      deepest_ = std::max(deepest_, truth.depth());
      tally_.check(truth.depth(), {allowed, "m", kMissing}, Where::pair(m.step, pair.i, pair.j, "points"), worked);
      return;
    }
    double deepest = 0.0;
    for (const std::uint32_t k : points) {
      const core::ContactPoint& p = point(k);
      const double told = std::max(0.0, -static_cast<double>(p.gap_m));
      deepest = std::max(deepest, told);
      judge_normal(m, pair, p, allowed, truth, worked);
      if (!tally_.check_bound(told, allowed))
        tally_.check(told - truth.depth(), {allowed, "m", kGap}, Where::pair(m.step, pair.i, pair.j, "points.gap"),
                     worked);
      judge_place(m, pair, p, allowed);
    }
    if (!tally_.check_bound(std::max(0.0, bound - deepest), allowed))
      tally_.check(truth.depth() - deepest, {allowed, "m", kGap}, Where::pair(m.step, pair.i, pair.j, "points.gap"),
                   worked);
  }

  template <typename Worked>
  void judge_normal(const Motion& m, core::Pair pair, const core::ContactPoint& p, double allowed, Truth& truth,
                    const Worked& worked) {
    const Where where = Where::pair(m.step, pair.i, pair.j, "points.normal");
    const double size = length(Vec3d(p.normal));
    tally_.check(std::abs(size - 1.0), {rounding(8), "", "a unit normal in float32"}, where);
    if (!(std::abs(size - 1.0) < 0.1)) return;
    // How deep the bodies are along the reported normal. Along the true normal this is least.
    const Vec3d n = (p.a == pair.i ? 1.0 : -1.0) / size * Vec3d(p.normal);
    const OrientedBox& a = boxes_[pair.i];
    const OrientedBox& b = boxes_[pair.j];
    const double bound = reach_along(a, n) + reach_along(b, n) - dot(a.center - b.center, n);
    if (tally_.check_bound(std::max(0.0, bound), allowed)) return;
    const double along = exact::overlap_along(truth.placed(pair.i), truth.placed(pair.j), to_point(n));
    tally_.check(along - truth.depth(), {allowed, "m", kNormal}, where, worked);
  }

  // A point of contact lies near both surfaces.
  void judge_place(const Motion& m, core::Pair pair, const core::ContactPoint& p, double allowed) {
    const double limit = allowed + std::abs(static_cast<double>(p.gap_m));
    for (const std::uint32_t i : {pair.i, pair.j})
      judge_outside(m, i, p, limit, Where::pair(m.step, pair.i, pair.j, "points.point"));
  }

  void judge_outside(const Motion& m, std::uint32_t i, const core::ContactPoint& p, double limit, const Where& where) {
    // The distance from a box around the shape is a lower bound of that from the shape; for boxes and balls it is
    // exact.
    double away = distance_outside(boxes_[i], Vec3d(p.point));
    const core::Mesh& mesh = *header_.scene.meshes[m.facts[i].mesh];
    if (!is_its_own_box(m.facts[i].mesh, mesh)) {
      exact::ConvexCore alone;
      alone.vertices = {to_point(Vec3d(p.point))};
      const auto shape = shapes_.placed(m.facts[i].mesh, poses_[i]->origin, poses_[i]->q);
      away = std::max(0.0, exact::signed_distance(alone, shape).distance_m);
    }
    tally_.check(away, {limit, "m", kPlace}, where, [&] {
      return "the point " + vector_text(Vec3d(p.point)) + " m is " + number_text(away) + " m outside " + body_text(i);
    });
  }

  bool is_its_own_box(std::uint32_t index, const core::Mesh& mesh) {
    if (own_box_.size() <= index) own_box_.resize(index + 1);
    if (!own_box_[index]) {
      const auto primitive = core::primitive_of(mesh);
      own_box_[index] = primitive && (primitive->kind == core::PrimitiveKind::kBox ||
                                      primitive->kind == core::PrimitiveKind::kSphere);
    }
    return *own_box_[index];
  }

  void judge_faces(const Motion& m, std::uint32_t i) {
    for (std::uint32_t face = 0; face < static_cast<std::uint32_t>(core::kFaceCount); ++face) {
      const int axis = static_cast<int>(face / 2);
      const double inward = face % 2 == 1 ? -1.0 : 1.0;
      const double wall = face % 2 == 1 ? header_.scene.domain.max[axis] : header_.scene.domain.min[axis];
      const auto height = [&](Vec3d p) { return inward * (p[axis] - wall); };
      const double bound = reach_along(boxes_[i], axis_vector(axis)) - height(boxes_[i].center);
      const Points points = points_of(i, core::kFirstFace + face);
      const double allowed = band(m, i, core::kFirstFace + face);
      if (points.empty() && !(bound > -allowed)) continue;
      const auto shape = shapes_.placed(m.facts[i].mesh, poses_[i]->origin, poses_[i]->q);
      double depth = -std::numeric_limits<double>::infinity();
      for (const exact::Point& p : shape.vertices) depth = std::max(depth, shape.radius_m - height(to_vec3d(p)));
      judge_face(m, i, core::kFirstFace + face, std::max(0.0, depth), allowed, points);
    }
  }

  void judge_face(const Motion& m, std::uint32_t i, std::uint32_t face, double depth, double allowed, Points points) {
    const auto at = [&](std::string_view field) { return Where::pair(m.step, i, face, field); };
    const int axis = static_cast<int>((face - core::kFirstFace) / 2);
    const bool is_upper = (face - core::kFirstFace) % 2 == 1;
    const double wall = is_upper ? header_.scene.domain.max[axis] : header_.scene.domain.min[axis];
    const auto worked = [&] { return "the body is " + number_text(depth) + " m beyond the face"; };
    double deepest = 0.0;
    for (const std::uint32_t k : points) {
      const core::ContactPoint& p = point(k);
      const double told = std::max(0.0, -static_cast<double>(p.gap_m));
      deepest = std::max(deepest, told);
      tally_.check(length(Vec3d(p.normal) - (is_upper ? -1.0 : 1.0) * axis_vector(axis)),
                   {rounding(16), "", "the face's own normal, in float32"}, at("points.normal"));
      tally_.check(told - depth, {allowed, "m", kGap}, at("points.gap"), worked);
      const double limit = allowed + std::abs(static_cast<double>(p.gap_m));
      tally_.check(std::abs(Vec3d(p.point)[axis] - wall), {limit, "m", kPlace}, at("points.point"));
      judge_outside(m, i, p, limit, at("points.point"));
    }
    if (points.empty())
      tally_.check(depth, {allowed, "m", kMissing}, at("points"), worked);
    else
      tally_.check(depth - deepest, {allowed, "m", kGap}, at("points.gap"), worked);
  }

  // Points of two bodies whose swept boxes do not meet.
  void judge_distant(const Motion& m, std::uint32_t index) {
    const core::ContactPoint& p = point(index);
    if (core::is_face(p.b) || p.impulse == core::Vec3{}) return;
    const core::Pair pair = core::make_pair_of(p.a, p.b);
    tally_.require(std::binary_search(m.near.begin(), m.near.end(), pair) || can_have_met(m, pair),
                   "bodies whose boxes, swept over the step, do not meet have no impulse between them",
                   Where::pair(m.step, pair.i, pair.j, "points"));
  }

  // Whether the bodies can have met inside a step of several substeps, although not at its ends.
  bool can_have_met(const Motion& m, core::Pair pair) {
    if (!has_substeps_) return false;
    std::vector<core::ContactPoint> own;
    for (const std::uint32_t k : points_of(pair.i, pair.j)) own.push_back(point(k));
    const double apart_m = -overlap_bound(oriented_box(m.facts[pair.i], m.bodies[pair.i].before),
                                          oriented_box(m.facts[pair.j], m.bodies[pair.j].before));
    return apart_m <= meetings_.way_m(m, pair, own) + margin_ + header_.scene.parameters.delta_m;
  }

  static constexpr Vec3d axis_vector(int axis) {
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
  }

  static constexpr std::string_view kMissing = "slop, margin and one step's approach: a deeper overlap has a point";
  static constexpr std::string_view kNormal =
      "the overlap along the reported normal is the least depth, within slop, margin and one step's approach";
  static constexpr std::string_view kGap = "the exact depth, within slop, margin and one step's approach";
  static constexpr std::string_view kPlace = "a point lies on both surfaces, within its gap and the same band";

  const core::TraceHeader& header_;
  ExactShapes shapes_;
  double margin_;
  bool has_substeps_;
  bool finds_within_ = false;  // in the frame that it looks at
  WaysWithin ways_;
  MeetingWithin meetings_;
  const core::FrameRecord* frame_ = nullptr;
  std::vector<std::optional<DetectionPose>> poses_;
  std::vector<OrientedBox> boxes_;  // at these poses
  std::vector<std::uint32_t> sorted_;
  std::vector<std::optional<bool>> own_box_;  // by mesh
  double deepest_ = 0.0;
  Tally tally_{"contact-truth", "properties of contacts", kMissing};
};

}  // namespace

ValidatorRow contact_truth_row() {
  constexpr std::uint32_t kNeeded = core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints);
  return {"contact-truth",
          "bodies that overlap have points of contact, whose place, normal and gap are those of the exact shapes",
          "an ignored pair; flipped normals; wrong depths; points 10 cm off",
          kNeeded | core::bit(core::Group::kDetection) | core::bit(core::Group::kDetectedOrientation),
          0,
          [](const Subject& subject) {
            return lacking(subject.header, core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints));
          },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<ContactTruth>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
