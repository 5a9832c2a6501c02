#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "validation/mechanics/motion.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

class Unilateral final : public Validator {
 public:
  explicit Unilateral(const Subject& subject) : margin_m_(subject.header.declaration.number("contact_margin_m")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    pushed_.clear();
    for (const core::ContactPoint& p : evidence.frame.points) pushed_[{p.a, p.b}] += length(Vec3d(p.impulse));
    for (const core::ContactPoint& p : evidence.frame.points) {
      if (p.impulse == core::Vec3{}) continue;
      const Vec3d at(p.point);
      const Vec3d n(p.normal);
      // How fast they came, or, where another contact drove them on within the step, how fast they would have met
      // without their own impulses.
      const double came = -dot(speed_at(m, p.a, at, false) - speed_at(m, p.b, at, false), n);
      const double left = -dot(speed_at(m, p.a, at, true) - speed_at(m, p.b, at, true), n);
      const double approach = std::max(came, left + (mobility(m, p.a) + mobility(m, p.b)) * pushed_[{p.a, p.b}]);
      // Gravity may bring them together within the step.
      const double reach = m.h * (std::max(0.0, approach) + m.h * m.strongest_pull);
      const double limit = margin_m_ + reach + rounding(8) * (length(at) + std::abs(reach));
      tally_.check(p.gap_m, {limit, "m", kOrigin}, Where::pair(m.step, p.a, p.b, "points.gap"), [&] {
        return "an impulse over a gap of " + number_text(p.gap_m) + " m that closes at " + number_text(approach) +
               " m/s";
      });
    }
  }

  core::Verdict conclude() override { return tally_.conclude("no point of contact with an impulse"); }

 private:
  [[nodiscard]] static Vec3d speed_at(const Motion& m, std::uint32_t body, Vec3d point, bool is_after) {
    if (core::is_face(body) || !m.facts[body].is_dynamic) return {};
    const BodyState& s = is_after ? m.bodies[body].after : m.bodies[body].before;
    return s.v + cross(s.w, point - s.x);
  }

  // At most how fast a point of the body moves for an impulse of 1 N s on it.
  [[nodiscard]] static double mobility(const Motion& m, std::uint32_t body) {
    if (core::is_face(body) || !m.facts[body].is_dynamic) return 0.0;
    const BodyFacts& f = m.facts[body];
    return 1.0 / f.mass_kg + (f.has_inertia ? f.reach_m * f.reach_m / f.least_moment : 0.0);
  }

  static constexpr std::string_view kOrigin =
      "the declared margin, h times the approach speed with gravity, and rounding";
  double margin_m_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> pushed_;  // N s, by the bodies of the points
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
          [](const Subject& subject) {
            return lacking(subject.header, core::bit(core::Group::kBodies) | core::bit(core::Group::kPoints));
          },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Unilateral>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
