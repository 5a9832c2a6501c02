#include "validation/validator.hpp"

#include <algorithm>

#include "validation/mechanics/motion.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::validation {
namespace {

constexpr int kMostHalvings = 16;

class Passage final : public Validator {
 public:
  explicit Passage(const Subject& subject) : scene_(subject.header.scene), shapes_(scene_) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (const core::Pair p : m.near) judge(m, p);
  }

  core::Verdict conclude() override {
    return tally_.conclude("no two bodies with convex shapes moved fast enough past each other to pass through");
  }

 private:
  struct Pose {
    Vec3d x;
    Quatd q;
  };

  // Between the two recorded poses: the center of mass on a line, the turn at a constant rate.
  [[nodiscard]] static Pose pose_at(const Motion& m, std::uint32_t i, double t) {
    const BodyStep& b = m.bodies[i];
    const Quatd turn = b.after.q * conjugate(b.before.q);
    const double angle = angle_of(turn);
    const double sign = turn.w < 0.0 ? -1.0 : 1.0;
    const Vec3d axis{sign * turn.x, sign * turn.y, sign * turn.z};
    const double size = length(axis);
    const Quatd q = size > 0.0 ? turn_by((t * angle / size) * axis) * b.before.q : b.before.q;
    return {b.before.x + t * (b.after.x - b.before.x), q};
  }

  [[nodiscard]] double distance_at(const Motion& m, core::Pair pair, double t) const {
    const auto placed = [&](std::uint32_t i) {
      const Pose p = pose_at(m, i, t);
      const BodyFacts& f = m.facts[i];
      return shapes_.placed(f.mesh, p.x - matrix_of(p.q) * f.center_of_mass, p.q);
    };
    return exact::signed_distance(placed(pair.i), placed(pair.j)).distance_m;
  }

  void judge(const Motion& m, core::Pair pair) {
    const BodyFacts& fa = m.facts[pair.i];
    const BodyFacts& fb = m.facts[pair.j];
    if (!shapes_.knows(fa.mesh) || !shapes_.knows(fb.mesh)) return;
    const BodyStep& a = m.bodies[pair.i];
    const BodyStep& b = m.bodies[pair.j];
    const auto swing = [](const BodyStep& s, const BodyFacts& f) {
      return f.reach_m * angle_of(s.after.q * conjugate(s.before.q));
    };
    // No two points of the bodies come closer by more than this in the step.
    const double moved = length((a.after.x - a.before.x) - (b.after.x - b.before.x)) + swing(a, fa) + swing(b, fb);
    const double allowed = 0.5 * std::min(fa.smallest_side_m, fb.smallest_side_m);
    // What is not deep at the ends cannot have been much deeper between them: penetration judges the ends.
    if (moved <= allowed) return;
    const double d0 = distance_at(m, pair, 0.0);
    const double d1 = distance_at(m, pair, 1.0);
    const double limit = allowed + std::max({0.0, -d0, -d1});
    const double deepest = search(m, pair, {0.0, d0}, {1.0, d1}, moved, limit, 0);
    tally_.check(deepest, {limit, "m", kOrigin}, Where::pair(m.step, pair.i, pair.j, "bodies.position"), [&] {
      return "apart by " + number_text(d0) + " and " + number_text(d1) + " m at the two ends, and " +
             number_text(deepest) + " m deep between them";
    });
  }

  struct Sample {
    double t;
    double d;
  };

  // The deepest overlap found; at once when it breaks the limit. Where the certified bound, (d0 + d1 - M) / 2 for a
  // motion of at most M, holds, no more is looked for.
  [[nodiscard]] double search(const Motion& m, core::Pair pair, Sample p, Sample q, double moved, double limit,
                              int depth) const {
    const double found = std::max(-p.d, -q.d);
    if (found > limit || 0.5 * (p.d + q.d - moved) >= -limit || depth == kMostHalvings) return found;
    const double t = 0.5 * (p.t + q.t);
    const Sample middle{t, distance_at(m, pair, t)};
    const double left = search(m, pair, p, middle, 0.5 * moved, limit, depth + 1);
    return left > limit ? left : std::max(left, search(m, pair, middle, q, 0.5 * moved, limit, depth + 1));
  }

  static constexpr std::string_view kOrigin =
      "half of the smaller body's smallest side, beyond the depth at the ends: certified by conservative advancement";
  const core::Scene& scene_;
  ExactShapes shapes_;
  Tally tally_{"passage", "fast encounters", kOrigin};
};

}  // namespace

ValidatorRow passage_row() {
  return {"passage",
          "between two frames no body passes through another one",
          "tunnelling",
          core::bit(core::Group::kBodies),
          0,
          [](const Subject& subject) { return lacking(subject.header, core::bit(core::Group::kBodies)); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Passage>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
