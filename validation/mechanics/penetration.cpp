#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/oriented_box.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Shares of the smaller body's smallest side.
constexpr double kClassBShare = 0.05;
constexpr double kClassCShare = 0.5;

class Penetration final : public Validator {
 public:
  explicit Penetration(const Subject& subject)
      : scene_(subject.header.scene),
        shapes_(scene_),
        contact_time_s_(subject.header.declaration.number("contact_time_s")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    boxes_.clear();
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) boxes_.push_back(oriented_box(m.facts[i], m.bodies[i].after));
    for (const core::Pair pair : m.near) judge_pair(m, pair);
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i)
      if (m.facts[i].is_dynamic) judge_ground(m, i);
  }

  core::Verdict conclude() override {
    const char* name =
        worst_share_ > kClassCShare ? "below C" : (worst_share_ > kClassBShare ? "C" : (is_beyond_a_ ? "B" : "A"));
    return tally_.conclude("no body with a convex shape came near another one or the ground",
                           std::string("class ") + name);
  }

 private:
  [[nodiscard]] double approach(const Motion& m, std::uint32_t i) const {
    const BodyState& s = m.bodies[i].before;
    return m.h * (length(s.v) + length(s.w) * m.facts[i].reach_m + m.h * m.strongest_pull);
  }

  void judge_pair(const Motion& m, core::Pair pair) {
    const BodyFacts& fa = m.facts[pair.i];
    const BodyFacts& fb = m.facts[pair.j];
    if (!shapes_.knows(fa.mesh) || !shapes_.knows(fb.mesh)) return;
    const double size = std::min(fa.smallest_side_m, fb.smallest_side_m);
    const double near = approach(m, pair.i) + approach(m, pair.j);
    if (holds_at_most(m, overlap_bound(boxes_[pair.i], boxes_[pair.j]), size, near)) return;
    const auto depth_of = [&](const BodyState& a, const BodyState& b) {
      return -exact::signed_distance(shapes_.placed(fa.mesh, a.origin, a.q), shapes_.placed(fb.mesh, b.origin, b.q))
                  .distance_m;
    };
    const BodyStep& a = m.bodies[pair.i];
    const BodyStep& b = m.bodies[pair.j];
    judge(m, Where::pair(m.step, pair.i, pair.j, "bodies.position"), depth_of(a.after, b.after), size, near,
          [&] { return depth_of(a.before, b.before); });
  }

  void judge_ground(const Motion& m, std::uint32_t i) {
    const BodyFacts& f = m.facts[i];
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        const Vec3d out{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
        const double wall = is_upper ? scene_.domain.max[axis] : scene_.domain.min[axis];
        const double center = boxes_[i].center[axis];
        const double bound = (is_upper ? center - wall : wall - center) + reach_along(boxes_[i], out);
        if (!(bound > 0.0) || holds_at_most(m, bound, f.smallest_side_m, approach(m, i))) continue;
        const std::uint32_t face = core::kFirstFace + 2 * static_cast<std::uint32_t>(axis) + (is_upper ? 1U : 0U);
        const auto depth_of = [&](const BodyState& s) { return depth_beyond(f, s, axis, is_upper, wall); };
        judge(m, Where::pair(m.step, i, face, "bodies.position"), depth_of(m.bodies[i].after), f.smallest_side_m,
              approach(m, i), [&] { return depth_of(m.bodies[i].before); });
      }
  }

  // Valid for any shape: no point of a mesh is farther out than its vertices.
  [[nodiscard]] double depth_beyond(const BodyFacts& f, const BodyState& s, int axis, bool is_upper,
                                    double wall) const {
    double depth = -std::numeric_limits<double>::infinity();
    const auto add = [&](Vec3d p) { depth = std::max(depth, is_upper ? p[axis] - wall : wall - p[axis]); };
    if (!shapes_.knows(f.mesh)) {
      for (const core::Vec3 v : scene_.meshes[f.mesh]->vertices) add(s.origin + s.r * Vec3d(v));
      return depth;
    }
    const auto shape = shapes_.placed(f.mesh, s.origin, s.q);
    for (const exact::Point& p : shape.vertices) add(to_vec3d(p));
    return depth + shape.radius_m;
  }

  // Slop and one step's approach; a compliant contact sinks in until it carries the weight: |g| times its time
  // constant squared.
  [[nodiscard]] double class_a(const Motion& m, double approach) const {
    return scene_.parameters.delta_m + approach + m.strongest_pull * contact_time_s_ * contact_time_s_;
  }

  // Whether the depth, of which only a bound is known, changes nothing in the verdict.
  bool holds_at_most(const Motion& m, double bound, double size, double approach) {
    return (is_beyond_a_ || bound <= class_a(m, approach)) &&
           tally_.check_bound(std::max(0.0, bound), kClassCShare * size);
  }

  // depth_at_start(): at the start of the step.
  template <typename DepthAtStart>
  void judge(const Motion& m, const Where& where, double signed_depth, double size, double approach,
             const DepthAtStart& depth_at_start) {
    const double depth = std::max(0.0, signed_depth);
    const double share = depth / size;
    const std::pair bodies(where.bodies[0], where.bodies[1]);
    // Bodies that the scene itself puts this deep may stay so.
    if (m.step == 1 && share > kClassCShare)
      if (const double start = depth_at_start(); start > kClassCShare * size) given_[bodies] = start + approach;
    const auto given = given_.find(bodies);
    if (given != given_.end() && depth <= given->second) {
      tally_.check(depth, {given->second, "m", kGiven}, where);
      return;
    }
    worst_share_ = std::max(worst_share_, share);
    is_beyond_a_ = is_beyond_a_ || depth > class_a(m, approach);
    tally_.check(depth, {kClassCShare * size, "m", kOrigin}, where, [&] {
      return "a depth of " + number_text(depth) + " m is " + number_text(100.0 * share) + " % of the smaller body";
    });
  }

  static constexpr std::string_view kOrigin =
      "class C: half of the smaller body's smallest side (A: slop and one step's approach; B: a twentieth)";
  static constexpr std::string_view kGiven = "the depth that the scene starts with, and one step's approach";
  const core::Scene& scene_;
  ExactShapes shapes_;
  double contact_time_s_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double>
      given_;  // m, by bodies that the scene puts deeper than class C
  double worst_share_ = 0.0;
  bool is_beyond_a_ = false;
  std::vector<OrientedBox> boxes_;  // at the end of the step
  Tally tally_{"penetration", "overlaps", kOrigin};
};

std::string why_not_penetration(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  // How much of a depth an application corrects is a parameter of the scene there.
  if (subject.header.declaration.follows_method())
    return "the validator contraction judges each correction of the method";
  return {};
}

}  // namespace

ValidatorRow penetration_row() {
  return {"penetration",
          "at the end of a step no body is deeper in another or in the ground than half of its smallest side",
          "a body 3 m under the floor; an ignored pair",
          core::bit(core::Group::kBodies),
          0,
          why_not_penetration,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Penetration>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
