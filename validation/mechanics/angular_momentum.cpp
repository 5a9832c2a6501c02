#include <algorithm>
#include <vector>

#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/sleeping.hpp"
#include "validation/mechanics/ways_within.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class AngularMomentum final : public Validator {
 public:
  explicit AngularMomentum(const Subject& subject)
      : header_(subject.header),
        is_told_at_start_(is_at_start(header_.declaration.text("detection_at"))),
        accumulations_(subject.header.declaration.number("iterations") * subject.header.declaration.number("substeps")),
        rate_(correction_rate(subject.header)),
        sleep_speed_m_s_(subject.header.declaration.number("sleep_speed_m_s")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    const std::size_t n = m.bodies.size();
    finds_within_ = finds_within(header_, evidence.frame);
    moment_.assign(n, {});
    slack_.assign(n, 0.0);
    scale_.swap(scale_before_);
    if (m.step != last_step_ + 1) scale_before_.clear();
    last_step_ = m.step;
    scale_before_.resize(n);
    scale_.assign(n, 0.0);
    pushed_.assign(n, 0.0);
    points_.assign(n, 0.0);
    if (finds_within_) ways_.read(m, evidence.frame.points);
    for (const core::ContactPoint& p : evidence.frame.points) {
      const Vec3d j(p.impulse);
      give(m, p, p.a, 1.0, j);
      if (!core::is_face(p.b)) give(m, p, p.b, -1.0, j);
    }
    for (std::uint32_t i = 0; i < n; ++i)
      if (points_[i] > 0.0) judge(m, i);
  }

  core::Verdict conclude() override { return tally_.conclude("no body with a reported point of contact"); }

 private:
  static bool is_at_start(std::string_view detection_at) { return detection_at == "start" || detection_at == "within"; }

  // The point is at the pose of detection; by the end of the step it and the center have moved.
  void give(const Motion& m, const core::ContactPoint& p, std::uint32_t body, double sign, Vec3d j) {
    const BodyStep& b = m.bodies[body];
    const Vec3d at = is_told_at_start_ ? b.before.x : b.after.x;
    const Vec3d arm = Vec3d(p.point) - at;
    const double size = length(j);
    moment_[body] = moment_[body] + sign * cross(arm, j);
    const double moved = finds_within_       ? ways_.way_m(body, length(arm))
                         : is_told_at_start_ ? 0.0
                                             : length(b.after.x - b.before.x) + m.h * length(b.after.w) * length(arm);
    // The point lies between the two surfaces, which are |gap| apart along the normal: only an impulse across the
    // normal has a moment that depends on where in the gap the point lies.
    const Vec3d n(p.normal);
    slack_[body] += size * moved + length(j - dot(j, n) * n) * std::abs(static_cast<double>(p.gap_m));
    // The point is recorded in float32.
    slack_[body] += size * rounding(2) * (length(Vec3d(p.point)) + length(arm));
    scale_[body] += size * length(arm);
    pushed_[body] += m.facts[body].mass_kg * rate_ * std::max(0.0, -static_cast<double>(p.gap_m)) / m.h * length(arm);
    points_[body] += 1.0;
  }

  void judge(const Motion& m, std::uint32_t i) {
    const BodyFacts& f = m.facts[i];
    if (!f.is_dynamic || !f.has_inertia) return;
    const BodyStep& b = m.bodies[i];
    // The change without what the scene's own torque gives.
    const Vec3d change = b.after.angular_momentum - b.before.angular_momentum - m.h * b.torque;
    // The gyroscopic torque may be that of the spin before or after the impulses.
    const double gyroscopic = m.h * (length(cross(b.before.w, b.before.angular_momentum)) +
                                     length(cross(b.after.w, b.after.angular_momentum)));
    // The rounding of turning L back is divided by the least moment, and multiplied by the largest one.
    const double spin = length(b.before.w) + length(b.after.w) +
                        (length(b.before.angular_momentum) + length(b.after.angular_momentum)) / f.least_moment;
    // Solvers begin with the impulses of the step before, and take back what is too much. They also take back the speed
    // at which a correction parts bodies.
    const double scale = f.largest_moment * spin + scale_[i] + scale_before_[i] + pushed_[i];
    const double limit = gyroscopic + slack_[i] + m.rounding_of(40 + 2 * accumulations_ * points_[i]) * scale +
                         rounding(4) * scale_[i] + kSubnormal + m.h * b.torque_slack +
                         f.largest_moment / f.reach_m * slack_of_sleep_m_s(b, f, sleep_speed_m_s_);
    tally_.check(
        length(change - moment_[i]), {limit, "N m s", kOrigin}, Where::body(m.step, i, "bodies.angular_velocity"), [&] {
          return "dL = " + vector_text(change) + " N m s, sum (p - x) x J = " + vector_text(moment_[i]) + " N m s";
        });
  }

  static constexpr std::string_view kOrigin =
      "h |w x L| before and after, |J_t| times the gap, |J| times how far point and center move, twice the declared "
      "speed of sleep of a body that stands still, and rounding, also of the impulses of the step before, with which "
      "solvers begin, and of the speed at which a declared correction parts bodies";
  const core::TraceHeader& header_;
  bool is_told_at_start_;
  bool finds_within_ = false;  // in the frame that it looks at
  WaysWithin ways_;
  double accumulations_;
  double rate_;
  double sleep_speed_m_s_;
  std::vector<Vec3d> moment_;
  std::vector<double> slack_;
  std::vector<double> scale_;
  std::vector<double> scale_before_;  // in the step before
  std::vector<double> pushed_;
  std::uint64_t last_step_ = 0;
  std::vector<double> points_;
  Tally tally_{"angular-momentum", "angular momenta", kOrigin};
};

std::string why_not_angular_momentum(const Subject& subject) {
  if (std::string text = lacking_impulses(subject.header); !text.empty()) return text;
  return subject.header.scene.motion == core::Motion::kTranslate ? "the scene's bodies translate only" : "";
}

}  // namespace

ValidatorRow angular_momentum_row() {
  return {
      "angular-momentum",
      "a body's angular momentum changes by the moments of its impulses",
      "torque from nowhere; points 10 cm off",
      core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints),
      0,
      why_not_angular_momentum,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<AngularMomentum>(subject); },
      false,
      true};
}

}  // namespace broadside::validation
