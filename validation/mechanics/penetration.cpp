#include <algorithm>

#include "validation/mechanics/motion.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Pairs measured exactly in one frame; of more, every k-th, another k-th in each frame.
constexpr std::size_t kMostPairs = 2000;
// Shares of the smaller body's smallest side.
constexpr double kClassB = 0.05;
constexpr double kClassC = 0.5;

class Penetration final : public Validator {
 public:
  explicit Penetration(const Subject& subject)
      : scene_(subject.header.scene),
        shapes_(scene_),
        contact_time_s_(subject.header.declaration.number("contact_time_s")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    const std::size_t stride = m.near.size() / kMostPairs + 1;
    sampled_ = sampled_ || stride > 1;
    for (std::size_t k = m.step % stride; k < m.near.size(); k += stride) judge_pair(m, m.near[k]);
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i)
      if (m.facts[i].is_dynamic && !m.bodies[i].is_alone) judge_ground(m, i);
  }

  core::Verdict conclude() override {
    const char* name = worst_share_ > kClassC ? "below C" : (worst_share_ > kClassB ? "C" : (is_beyond_a_ ? "B" : "A"));
    return tally_.conclude("no two bodies with convex shapes came near each other, and none the ground",
                           std::string("class ") + name + (sampled_ ? "; not every pair in every frame" : ""));
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
    const BodyState& sa = m.bodies[pair.i].after;
    const BodyState& sb = m.bodies[pair.j].after;
    const double distance =
        exact::signed_distance(shapes_.placed(fa.mesh, sa.origin, sa.q), shapes_.placed(fb.mesh, sb.origin, sb.q))
            .distance_m;
    judge(m, Where::pair(m.step, pair.i, pair.j, "bodies.position"), -distance,
          std::min(fa.smallest_side_m, fb.smallest_side_m), approach(m, pair.i) + approach(m, pair.j));
  }

  void judge_ground(const Motion& m, std::uint32_t i) {
    const BodyFacts& f = m.facts[i];
    if (!shapes_.knows(f.mesh)) return;
    const BodyState& s = m.bodies[i].after;
    const auto shape = shapes_.placed(f.mesh, s.origin, s.q);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        double depth = -1e300;
        for (const exact::Point& p : shape.vertices) {
          const double at = to_vec3d(p)[axis];
          depth = std::max(depth, is_upper ? at - scene_.domain.max[axis] : scene_.domain.min[axis] - at);
        }
        const std::uint32_t face = core::kFirstFace + 2 * static_cast<std::uint32_t>(axis) + (is_upper ? 1U : 0U);
        judge(m, Where::pair(m.step, i, face, "bodies.position"), depth + shape.radius_m, f.smallest_side_m,
              approach(m, i));
      }
  }

  void judge(const Motion& m, const Where& where, double depth, double size, double approach) {
    if (!(depth > 0.0)) return;
    const double share = depth / size;
    worst_share_ = std::max(worst_share_, share);
    // A compliant contact sinks in until it carries the weight: |g| times its time constant squared.
    const double sunk = m.strongest_pull * contact_time_s_ * contact_time_s_;
    is_beyond_a_ = is_beyond_a_ || depth > scene_.parameters.delta_m + approach + sunk;
    tally_.check(depth, {kClassC * size, "m", kOrigin}, where, [&] {
      return "a depth of " + number_text(depth) + " m is " + number_text(100.0 * share) + " % of the smaller body";
    });
  }

  static constexpr std::string_view kOrigin =
      "class C: half of the smaller body's smallest side (A: slop and one step's approach; B: a twentieth)";
  const core::Scene& scene_;
  ExactShapes shapes_;
  double contact_time_s_;
  double worst_share_ = 0.0;
  bool is_beyond_a_ = false;
  bool sampled_ = false;
  Tally tally_{"penetration", "overlaps", kOrigin};
};

}  // namespace

ValidatorRow penetration_row() {
  return {"penetration",
          "at the end of a step no body is deeper in another or in the ground than half of its smallest side",
          "a body 3 m under the floor; an ignored pair",
          core::bit(core::Group::kBodies),
          0,
          [](const Subject& subject) { return lacking(subject.header, core::bit(core::Group::kBodies)); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Penetration>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
