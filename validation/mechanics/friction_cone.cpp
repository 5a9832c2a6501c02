#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "validation/mechanics/point_speed.hpp"
#include "validation/mechanics/scene_friction.hpp"
#include "validation/mechanics/ways_within.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

struct Friction {
  double most = 0.0;   // coefficient
  double least = 0.0;  // of a point that slides
};

class FrictionCone final : public Validator {
 public:
  explicit FrictionCone(const Subject& subject)
      : header_(subject.header),
        scene_(subject.header.scene),
        model_(subject.header.declaration.text("friction")),
        has_substeps_(subject.header.declaration.number("substeps") > 1.0) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    finds_within_ = finds_within(header_, evidence.frame);
    sum_impulses(*evidence.motion, evidence.frame.points);
    if (finds_within_) ways_.read(*evidence.motion, evidence.frame.points);
    for (const core::ContactPoint& p : evidence.frame.points) judge(*evidence.motion, p);
  }

  core::Verdict conclude() override { return tally_.conclude("no point of contact with an impulse"); }

 private:
  [[nodiscard]] Friction friction_of(const core::ContactPoint& p) const {
    const SceneFriction mu = scene_friction(scene_, p);
    const double widest = model_ == "pyramid" ? std::sqrt(2.0) : 1.0;
    return {widest * mu.larger(), model_ == "regularized" ? 0.0 : std::min(mu.fixed, mu.sliding)};
  }

  // The sums of what all impulses of the step did to a body, by magnitude.
  struct Pushed {
    double dv = 0.0;  // m/s
    double dw = 0.0;  // rad/s
  };

  void sum_impulses(const Motion& m, std::span<const core::ContactPoint> points) {
    pushed_.assign(m.bodies.size(), {});
    const auto add = [&](std::uint32_t body, const core::ContactPoint& p) {
      if (core::is_face(body)) return;
      const Change c = change_by(m, body, Vec3d(p.point), Vec3d(p.impulse));
      pushed_[body].dv += length(c.dv);
      pushed_[body].dw += length(c.dw);
    };
    for (const core::ContactPoint& p : points) add(p.a, p), add(p.b, p);
  }

  // How much the other impulses on the body changed the point's speed at most, before or after this one acted.
  [[nodiscard]] double change_by_others(const Motion& m, std::uint32_t body, const core::ContactPoint& p) const {
    if (core::is_face(body)) return 0.0;
    const Change own = change_by(m, body, Vec3d(p.point), Vec3d(p.impulse));
    const double arm = length(Vec3d(p.point) - m.bodies[body].before.x);
    return std::max(0.0, pushed_[body].dv - length(own.dv)) + arm * std::max(0.0, pushed_[body].dw - length(own.dw));
  }

  // How much the point's own impulse changed its slip at most. In substeps that impulse is a sum: the slip that its
  // first part opposed differs from that at the end by what its later parts did.
  [[nodiscard]] static double change_by_own(const Motion& m, const core::ContactPoint& p) {
    double sum = 0.0;
    for (const std::uint32_t body : {p.a, p.b}) {
      if (core::is_face(body)) continue;
      const Change own = change_by(m, body, Vec3d(p.point), Vec3d(p.impulse));
      sum += length(own.dv) + length(Vec3d(p.point) - m.bodies[body].before.x) * length(own.dw);
    }
    return sum;
  }

  // How far the slip may be off because the point was found within the step.
  [[nodiscard]] double change_by_way(const Motion& m, std::uint32_t body, const core::ContactPoint& p) const {
    if (!finds_within_ || core::is_face(body)) return 0.0;
    return ways_.speed_m_s(body, length(Vec3d(p.point) - m.bodies[body].before.x));
  }

  // How far the slip at the end may be from that at the moment at which friction acted: what gravity, the other
  // impulses and turning changed, and where in the gap the point is.
  [[nodiscard]] double open_slip(const Motion& m, const core::ContactPoint& p) const {
    double open = 2.0 * m.h * m.strongest_pull;
    for (const std::uint32_t body : {p.a, p.b})
      open += change_by_turning(m, body, Vec3d(p.point)) + change_by_others(m, body, p) + change_by_way(m, body, p);
    return open + std::abs(static_cast<double>(p.gap_m)) * spin(m, p);
  }

  void judge(const Motion& m, const core::ContactPoint& p) {
    const Vec3d j(p.impulse);
    const double size = length(j);
    if (size == 0.0) return;
    const Vec3d n(p.normal);
    const Vec3d at(p.point);
    const double push = dot(j, n);
    const Vec3d tangent = j - push * n;
    const double drag = length(tangent);
    // The impulse and the normal are recorded in float32; solvers sum both over their sweeps.
    const double off = rounding(16) * size + kSubnormal;
    const Where where = Where::pair(m.step, p.a, p.b, "points.impulse");
    const auto worked = [&] {
      return "J = " + vector_text(j) + " N s, along the normal " + number_text(push) + ", across " + number_text(drag);
    };
    tally_.check(-push, {off, "N s", "contacts push: J n >= 0, and rounding"}, where, worked);
    const Friction mu = friction_of(p);
    tally_.check(drag, {mu.most * std::max(0.0, push) + off, "N s", "mu J n of the scene, and rounding"}, where,
                 worked);

    const Vec3d relative = speed_at(m, p.a, at, Moment::kEnd) - speed_at(m, p.b, at, Moment::kEnd);
    const Vec3d slip = relative - dot(relative, n) * n;
    const double open = open_slip(m, p) + rounding(16) * length(relative);
    const double sliding = length(slip);
    const std::optional<Vec3d> before = slip_before(m, p, n, open);
    // The friction of a point whose slip reversed within the step partly cancels in the total. So the lower limit is
    // judged only for points whose slips at both ends lie within 60 degrees of each other.
    const bool slid_on = before && dot(*before, slip) >= 0.5 * length(*before) * sliding && length(*before) > 0.0;
    if (!(sliding > open) || drag <= off) {
      if (sliding > 4.0 * open && model_ == "cone" && slid_on)
        judge_least(mu, push, drag, open, sliding, off, where, worked);
      return;
    }
    // Friction acts against the slip at some moment of the step, which differs from that at the end by at most `open`;
    // so turned to the friction's direction, the slip is off by at most twice that.
    const double turned = open + (has_substeps_ ? change_by_own(m, p) : 0.0);
    tally_.check(length(slip + (sliding / drag) * tangent), {2.0 * turned, "m/s", kDirection}, where, [&] {
      return "friction " + vector_text(tangent) + " N s on A, which slides at " + vector_text(slip) + " m/s";
    });
    if (model_ != "regularized" && slid_on) judge_least(mu, push, drag, open, sliding, off, where, worked);
  }

  // Tangential velocity at the start. Nothing where the surfaces approached faster than gravity explains: in an impact
  // the point may have stuck, or slid in another direction than at the end.
  [[nodiscard]] static std::optional<Vec3d> slip_before(const Motion& m, const core::ContactPoint& p, Vec3d n,
                                                        double open) {
    const Vec3d at(p.point);
    const Vec3d came = speed_at(m, p.a, at, Moment::kStart) - speed_at(m, p.b, at, Moment::kStart);
    if (-dot(came, n) > open) return std::nullopt;
    return came - dot(came, n) * n;
  }

  template <typename Worked>
  void judge_least(const Friction& mu, double push, double drag, double open, double sliding, double off,
                   const Where& where, const Worked& worked) {
    const double share = std::max(0.0, 1.0 - 2.0 * open / sliding);
    const double least = mu.least * std::max(0.0, push) * share - off;
    tally_.check(least - drag, {0.0, "N s", "a point that slides is braked by mu_kinetic J n, less 2 open / slip"},
                 where, worked);
  }

  [[nodiscard]] static double spin(const Motion& m, const core::ContactPoint& p) {
    return length(m.bodies[p.a].after.w) + (core::is_face(p.b) ? 0.0 : length(m.bodies[p.b].after.w));
  }

  static constexpr std::string_view kDirection =
      "friction acts against the slip at some moment of the step: twice 2 |g| h and what turning and other impulses "
      "change, and in substeps its own";
  const core::TraceHeader& header_;
  const core::Scene& scene_;
  std::string_view model_;
  bool has_substeps_;
  bool finds_within_ = false;  // in the frame that it looks at
  WaysWithin ways_;
  std::vector<Pushed> pushed_;
  Tally tally_{"friction-cone", "impulses of points", "Coulomb's cone of the scene's friction"};
};

}  // namespace

ValidatorRow friction_cone_row() {
  constexpr std::uint32_t kRead = core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints);
  return {"friction-cone",
          "contacts only push; friction is at most mu J n, and where bodies slide it opposes them with all of that",
          "friction reversed; mu halved; contacts that pull",
          kRead,
          0,
          [](const Subject& subject) { return lacking_impulses(subject.header); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<FrictionCone>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
