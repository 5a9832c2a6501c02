#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "validation/mechanics/point_speed.hpp"
#include "validation/mechanics/scene_friction.hpp"
#include "validation/mechanics/ways_within.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class Unilateral final : public Validator {
 public:
  explicit Unilateral(const Subject& subject)
      : header_(subject.header),
        scene_(subject.header.scene),
        margin_m_(subject.header.declaration.number("contact_margin_m")),
        rate_(correction_rate(subject.header)),
        has_substeps_(subject.header.declaration.number("substeps") > 1.0) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    finds_within_ = finds_within(header_, evidence.frame);
    given_.clear();
    for (const core::ContactPoint& p : evidence.frame.points) given_[{p.a, p.b}].add(m, p);
    if (has_substeps_ || rate_ > 0.0) list_points(evidence.frame.points);
    if (finds_within_) ways_.read(m, evidence.frame.points);
    for (const core::ContactPoint& p : evidence.frame.points) {
      if (p.impulse == core::Vec3{}) continue;
      const Vec3d at(p.point);
      const Vec3d n(p.normal);
      const auto approach_at = [&](Moment moment) {
        return -dot(speed_at(m, p.a, at, moment) - speed_at(m, p.b, at, moment), n);
      };
      // The speed at which the bodies approached at the start; or, where another contact drove them together within the
      // step, the speed at which they would have met without this point's impulse, or without all impulses between the
      // two.
      const double came = approach_at(Moment::kStart);
      Given own;
      own.add(m, p);
      const double gained = std::max(own.speed_at_point(p, m), given_[{p.a, p.b}].speed_at_point(p, m));
      const double left = approach_at(Moment::kEnd) + change_by_turning(m, p.a, at) + change_by_turning(m, p.b, at);
      double approach = std::max(came, left + gained);
      // With substeps the impulses of a step come one after the other: this point's impulse may have come before others
      // slowed its bodies, and after others drove them together.
      if (has_substeps_) approach = std::max(approach, came + driven_by_others(m, evidence.frame.points, p));
      // Gravity may bring them together within the step.
      double reach = m.h * (std::max(0.0, approach) + m.h * m.strongest_pull);
      reach += arc_m(m, p, p.a) + arc_m(m, p, p.b);
      if (rate_ > 0.0) reach += moved_by_correction(m, evidence.frame.points, p);
      // A point that was found within the step is recorded where its surfaces were at the start.
      if (finds_within_) reach = std::max(reach, way_m(m, p, p.a) + way_m(m, p, p.b));
      const double limit = margin_m_ + reach + rounding(8) * (length(at) + std::abs(reach));
      tally_.check(p.gap_m, {limit, "m", kOrigin}, Where::pair(m.step, p.a, p.b, "points.gap"), [&] {
        return "an impulse over a gap of " + number_text(p.gap_m) + " m that closes at " + number_text(approach) +
               " m/s";
      });
    }
  }

  core::Verdict conclude() override { return tally_.conclude("no point of contact with an impulse"); }

 private:
  // The impulses between two bodies.
  struct Given {
    Change of_a;
    Change of_b;

    void add(const Motion& m, const core::ContactPoint& p) {
      const auto sum = [](Change& to, const Change& more) {
        to.dv = to.dv + more.dv;
        to.dw = to.dw + more.dw;
      };
      sum(of_a, change_by(m, p.a, Vec3d(p.point), Vec3d(p.impulse)));
      sum(of_b, change_by(m, p.b, Vec3d(p.point), -1.0 * Vec3d(p.impulse)));
    }
    // How much faster the bodies part at the point, along its normal, than without it.
    [[nodiscard]] double speed_at_point(const core::ContactPoint& p, const Motion& m) const {
      const auto speed = [&](std::uint32_t body, const Change& c) {
        return core::is_face(body) ? Vec3d{} : c.dv + cross(c.dw, Vec3d(p.point) - m.bodies[body].before.x);
      };
      return dot(speed(p.a, of_a) - speed(p.b, of_b), Vec3d(p.normal));
    }
  };

  void list_points(const std::vector<core::ContactPoint>& points) {
    points_of_.clear();
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      points_of_[points[k].a].push_back(k);
      if (!core::is_face(points[k].b)) points_of_[points[k].b].push_back(k);
    }
  }

  // At most by how much the impulses of other points, those that drive the bodies together and not those that part
  // them, can raise the approach at this point, m/s.
  double driven_by_others(const Motion& m, const std::vector<core::ContactPoint>& points,
                          const core::ContactPoint& p) const {
    return driven(m, points, p, p.a, 1.0) + driven(m, points, p, p.b, -1.0);
  }

  // For each other point q of a body. moves: the velocity that a unit impulse at p gives q's place, which by
  // reciprocity is what one there does at p. parts: the speed at which a unit impulse along q's normal parts p's
  // bodies. sign: 1 for the body that p's normal points to.
  template <typename Visit>
  void each_other(const Motion& m, const std::vector<core::ContactPoint>& points, const core::ContactPoint& p,
                  std::uint32_t body, double sign, const Visit& visit) const {
    const auto listed = points_of_.find(body);
    if (core::is_face(body) || !m.facts[body].is_dynamic || listed == points_of_.end()) return;
    const Change unit = change_by(m, body, Vec3d(p.point), sign * Vec3d(p.normal));
    for (const std::uint32_t k : listed->second) {
      const core::ContactPoint& q = points[k];
      if (&q == &p) continue;
      const Vec3d arm = Vec3d(q.point) - m.bodies[body].before.x;
      const Vec3d moves = unit.dv + cross(unit.dw, arm);
      visit(q, arm, moves, (q.a == body ? 1.0 : -1.0) * dot(moves, Vec3d(q.normal)));
    }
  }

  // An impulse's normal part only grows within a step; its friction may have had any direction, up to mu times that.
  double driven(const Motion& m, const std::vector<core::ContactPoint>& points, const core::ContactPoint& p,
                std::uint32_t body, double sign) const {
    double sum = 0.0;
    each_other(m, points, p, body, sign, [&](const core::ContactPoint& q, Vec3d, Vec3d moves, double parts) {
      const Vec3d n(q.normal);
      const double push = std::max(0.0, dot(Vec3d(q.impulse), n));
      sum += push * std::max(0.0, -parts);
      sum += scene_friction(scene_, q).larger() * push * length(moves - dot(moves, n) * n);
    });
    return sum;
  }

  // At most how far this point's gap is closed, m, where the depths of other points of its bodies are corrected. A
  // correction moves bodies as an impulse at the corrected point would, and no point records it.
  double moved_by_correction(const Motion& m, const std::vector<core::ContactPoint>& points,
                             const core::ContactPoint& p) const {
    return moved(m, points, p, p.a, 1.0) + moved(m, points, p, p.b, -1.0);
  }

  double moved(const Motion& m, const std::vector<core::ContactPoint>& points, const core::ContactPoint& p,
               std::uint32_t body, double sign) const {
    double sum = 0.0;
    each_other(m, points, p, body, sign, [&](const core::ContactPoint& q, Vec3d arm, Vec3d, double parts) {
      if (!(q.gap_m < 0.0F)) return;
      const Vec3d n(q.normal);
      const Change own = change_by(m, body, Vec3d(q.point), n);
      const double yields = dot(own.dv + cross(own.dw, arm), n);
      sum += rate_ * -static_cast<double>(q.gap_m) * std::max(0.0, -parts) / yields;
    });
    return sum;
  }

  [[nodiscard]] double way_m(const Motion& m, const core::ContactPoint& p, std::uint32_t body) const {
    return core::is_face(body) ? 0.0 : ways_.way_m(body, length(Vec3d(p.point) - m.bodies[body].before.x));
  }

  // A point of a body that turns by an angle t about an axis is off the tangent of its arc by at most t^2 / 2 of its
  // arm, since |exp(i t) - 1 - i t| <= t^2 / 2.
  static double arc_m(const Motion& m, const core::ContactPoint& p, std::uint32_t body) {
    if (core::is_face(body) || !m.facts[body].is_dynamic) return 0.0;
    const BodyStep& b = m.bodies[body];
    const double angle = m.h * std::max(length(b.before.w), length(b.after.w));
    return 0.5 * angle * angle * length(Vec3d(p.point) - b.before.x);
  }

  static constexpr std::string_view kOrigin =
      "the declared margin, h times the approach speed with gravity, wrenches and turning, the distance of an arc from "
      "its tangent, and rounding; with substeps also the approach that other impulses of the step may cause; how far "
      "the declared correction of other points' depths may move the bodies";
  const core::TraceHeader& header_;
  const core::Scene& scene_;
  double margin_m_;
  double rate_;
  bool has_substeps_;
  bool finds_within_ = false;  // in the frame that it looks at
  WaysWithin ways_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> points_of_;   // by body
  std::map<std::pair<std::uint32_t, std::uint32_t>, Given> given_;  // by the bodies of the points
  Tally tally_{"unilateral", "points with an impulse", kOrigin};
};

}  // namespace

ValidatorRow unilateral_row() {
  constexpr std::uint32_t kRead = core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints);
  return {"unilateral",
          "an impulse acts only where the gap is closed, within the margin, or closes within the step",
          "contacts at a distance",
          kRead,
          0,
          [](const Subject& subject) { return lacking_impulses(subject.header); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Unilateral>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
