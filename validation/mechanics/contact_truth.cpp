#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "validation/mechanics/detection_pose.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Pairs measured exactly in one frame; a frame with more has every k-th pair measured, another k-th in each frame.
constexpr std::size_t kMostPairs = 2000;

class ContactTruth final : public Validator {
 public:
  explicit ContactTruth(const Subject& subject)
      : header_(subject.header), shapes_(header_.scene), margin_(header_.declaration.number("contact_margin_m")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    frame_ = &evidence.frame;
    by_pair_.clear();
    for (const core::ContactPoint& p : frame_->points) by_pair_[{p.a, p.b}].push_back(&p);
    const std::size_t stride = m.near.size() / kMostPairs + 1;
    for (std::size_t k = m.step % stride; k < m.near.size(); k += stride) judge_pair(m, m.near[k]);
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i)
      if (m.facts[i].is_dynamic && !m.bodies[i].is_alone) judge_faces(m, i);
    for (const auto& [bodies, points] : by_pair_)
      if (!core::is_face(bodies.second)) judge_distant(m, bodies, *points.front());
  }

  core::Verdict conclude() override {
    return tally_.conclude("no two bodies with convex shapes came near each other",
                           "deepest overlap without an impulse was " + number_text(deepest_) + " m");
  }

 private:
  using Points = std::vector<const core::ContactPoint*>;

  [[nodiscard]] const Points* points_of(std::uint32_t a, std::uint32_t b, double& sign) const {
    sign = 1.0;
    auto found = by_pair_.find({a, b});
    if (found == by_pair_.end()) {
      sign = -1.0;
      found = by_pair_.find({b, a});
    }
    return found == by_pair_.end() ? nullptr : &found->second;
  }

  // Within this a contact may be seen or not: slop, margin, what the two come closer in a step, and float32.
  [[nodiscard]] double band(const Motion& m, std::uint32_t a, std::uint32_t b) const {
    const auto speed = [&](std::uint32_t i) {
      if (core::is_face(i)) return 0.0;
      const BodyState& s = m.bodies[i].before;
      return length(s.v) + length(s.w) * m.facts[i].reach_m;
    };
    const double size = m.facts[a].reach_m + length(m.bodies[a].after.x);
    return header_.scene.parameters.delta_m + margin_ + m.h * (speed(a) + speed(b) + m.h * m.strongest_pull) +
           rounding(16) * size;
  }

  void judge_pair(const Motion& m, core::Pair pair) {
    const auto pa = detection_pose(header_, *frame_, m, pair.i);
    const auto pb = detection_pose(header_, *frame_, m, pair.j);
    if (!pa || !pb || !shapes_.knows(m.facts[pair.i].mesh) || !shapes_.knows(m.facts[pair.j].mesh)) return;
    const auto a = shapes_.placed(m.facts[pair.i].mesh, pa->origin, pa->q);
    const auto b = shapes_.placed(m.facts[pair.j].mesh, pb->origin, pb->q);
    const exact::SignedDistance truth = exact::signed_distance(a, b);
    const double allowed = band(m, pair.i, pair.j);
    double sign = 1.0;
    const Points* points = points_of(pair.i, pair.j, sign);
    const Where where = Where::pair(m.step, pair.i, pair.j, "points");
    const auto worked = [&] {
      return "the exact distance is " + number_text(truth.distance_m) + " m along " +
             vector_text(to_vec3d(truth.normal)) + ", and " +
             (points == nullptr ? std::string("no point is reported") : std::to_string(points->size()) + " points are");
    };
    if (points == nullptr) {
      deepest_ = std::max(deepest_, -truth.distance_m);
      tally_.check(-truth.distance_m, {allowed, "m", kMissing}, where, worked);
      return;
    }
    for (const core::ContactPoint* p : *points) {
      const Vec3d n = sign * Vec3d(p->normal);
      const double size = length(n);
      tally_.check(std::abs(size - 1.0), {rounding(8), "", "a unit normal in float32"}, where);
      if (!(std::abs(size - 1.0) < 0.1)) continue;
      // How deep the bodies are along the reported normal: least along the true one.
      const double along = exact::overlap_along(a, b, to_point((1.0 / size) * n));
      const double depth = std::max(0.0, -truth.distance_m);
      tally_.check(along - depth, {allowed, "m", kNormal}, Where::pair(m.step, pair.i, pair.j, "points.normal"),
                   worked);
      tally_.check(std::max(0.0, -static_cast<double>(p->gap_m)) - depth, {allowed, "m", kGap},
                   Where::pair(m.step, pair.i, pair.j, "points.gap"), worked);
      judge_place(*p, a, b, allowed, where);
    }
    double deepest = 0.0;
    for (const core::ContactPoint* p : *points) deepest = std::max(deepest, -static_cast<double>(p->gap_m));
    tally_.check(-truth.distance_m - deepest, {allowed, "m", kGap}, Where::pair(m.step, pair.i, pair.j, "points.gap"),
                 worked);
  }

  // A point of contact lies near both surfaces.
  void judge_place(const core::ContactPoint& p, const exact::ConvexCore& a, const exact::ConvexCore& b, double allowed,
                   const Where& where) {
    exact::ConvexCore point;
    point.vertices = {to_point(Vec3d(p.point))};
    const double limit = allowed + std::abs(static_cast<double>(p.gap_m));
    for (const exact::ConvexCore* shape : {&a, &b}) {
      const double away = exact::signed_distance(point, *shape).distance_m;
      tally_.check(
          away, {limit, "m", kPlace}, Where{where.step, 2, {where.bodies[0], where.bodies[1]}, "points.point"}, [&] {
            return "the point " + vector_text(Vec3d(p.point)) + " m is " + number_text(away) + " m outside a body";
          });
    }
  }

  void judge_faces(const Motion& m, std::uint32_t i) {
    const auto pose = detection_pose(header_, *frame_, m, i);
    if (!pose || !shapes_.knows(m.facts[i].mesh)) return;
    const auto shape = shapes_.placed(m.facts[i].mesh, pose->origin, pose->q);
    for (std::uint32_t face = 0; face < static_cast<std::uint32_t>(core::kFaceCount); ++face) {
      const int axis = static_cast<int>(face / 2);
      const bool is_upper = face % 2 == 1;
      double depth = -1e300;
      for (const exact::Point& p : shape.vertices) {
        const double at = to_vec3d(p)[axis];
        depth = std::max(depth, is_upper ? at - header_.scene.domain.max[axis] : header_.scene.domain.min[axis] - at);
      }
      depth += shape.radius_m;
      judge_face(m, i, core::kFirstFace + face, depth, (is_upper ? -1.0 : 1.0) * axis_vector(axis));
    }
  }

  void judge_face(const Motion& m, std::uint32_t i, std::uint32_t face, double depth, Vec3d inward) {
    const double allowed = band(m, i, face);
    double sign = 1.0;
    const Points* points = points_of(i, face, sign);
    const Where where = Where::pair(m.step, i, face, "points");
    if (points == nullptr) {
      if (depth > -allowed) tally_.check(depth, {allowed, "m", kMissing}, where);
      return;
    }
    for (const core::ContactPoint* p : *points) {
      tally_.check(length(Vec3d(p->normal) - inward), {rounding(16), "", "the face's own normal, in float32"},
                   Where::pair(m.step, i, face, "points.normal"));
      tally_.check(-static_cast<double>(p->gap_m) - std::max(0.0, depth), {allowed, "m", kGap},
                   Where::pair(m.step, i, face, "points.gap"));
      const double reach = m.facts[i].reach_m + allowed + std::abs(static_cast<double>(p->gap_m));
      tally_.check(length(Vec3d(p->point) - m.bodies[i].before.x),
                   {reach + m.h * length(m.bodies[i].after.v), "m", kPlace},
                   Where::pair(m.step, i, face, "points.point"));
    }
  }

  // Points of bodies that were not even near.
  void judge_distant(const Motion& m, std::pair<std::uint32_t, std::uint32_t> bodies, const core::ContactPoint& p) {
    if (p.impulse == core::Vec3{}) return;
    const core::Pair pair = core::make_pair_of(bodies.first, bodies.second);
    tally_.require(std::binary_search(m.near.begin(), m.near.end(), pair),
                   "bodies whose boxes, swept over the step, do not meet have no impulse between them",
                   Where::pair(m.step, pair.i, pair.j, "points"));
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
  const core::FrameRecord* frame_ = nullptr;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Points> by_pair_;
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
