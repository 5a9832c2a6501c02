#include <algorithm>

#include "validation/mechanics/motion.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Where a step turns farther than this, its error is no longer of second order.
constexpr double kLargestTurn = 0.1;

class Gyroscopic final : public Validator {
 public:
  explicit Gyroscopic(const Subject& subject) : substeps_(subject.header.declaration.number("substeps")) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) {
      const BodyStep& b = m.bodies[i];
      if (!b.is_alone || !b.is_torque_free || !m.facts[i].has_inertia) continue;
      const double spin = std::max(length(b.before.w), length(b.after.w));
      if (m.h * spin > kLargestTurn) {
        ++too_fast_;
        continue;
      }
      const Vec3d l0 = b.before.angular_momentum;
      const Vec3d l1 = b.after.angular_momentum;
      const double torque = std::max(length(cross(b.before.w, l0)), length(cross(b.after.w, l1)));
      // A quaternion turns the inertia: 4 roundings and 12 operations, twice; the product with w. The rounding of
      // turning L back is divided by the least moment, and multiplied by the largest one.
      const double size = spin + std::max(length(l0), length(l1)) / m.facts[i].least_moment;
      // An engine that solves translations and turns together rounds a spin as it rounds the speed of the body's
      // points.
      const double shared = (length(b.before.v) + length(b.after.v)) / m.facts[i].reach_m;
      const double rounding =
          substeps_ * m.facts[i].largest_moment * (m.rounding_of(40) * size + m.rounding_of(2) * shared);
      judge_energy(m, i, torque, rounding * spin);
      tally_.check(length(l1 - l0), {0.5 * m.h * torque + rounding, "N m s", kOrigin},
                   Where::body(m.step, i, "bodies.angular_velocity"), [&] {
                     return "L went from " + vector_text(l0) + " to " + vector_text(l1) +
                            " N m s, h |w x L| = " + number_text(m.h * torque) + " N m s";
                   });
    }
  }

  core::Verdict conclude() override {
    return tally_.conclude("no moving body was free of contact for a whole step",
                           too_fast_ > 0 ? std::to_string(too_fast_) + " turned more than 0.1 rad in a step" : "");
  }

 private:
  // The energy of the spin is off by two terms of second order: that of the torque, h^2 T^2 / 2 over a moment, and as
  // much again from the orientation, whose inertia relates momentum to spin.
  void judge_energy(const Motion& m, std::uint32_t i, double torque, double rounding) {
    const BodyStep& b = m.bodies[i];
    const double e0 = 0.5 * dot(b.before.w, b.before.angular_momentum);
    const double e1 = 0.5 * dot(b.after.w, b.after.angular_momentum);
    const double turn = m.h * std::max(length(b.before.w), length(b.after.w));
    const double second = m.h * torque * m.h * torque / m.facts[i].least_moment;
    const double limit = second + turn * turn * turn / 12.0 * torque + rounding;
    tally_.check(std::abs(e1 - e0), {limit, "J", kOfEnergy}, Where::body(m.step, i, "bodies.angular_velocity"), [&] {
      return "the energy of the spin went from " + number_text(e0) + " to " + number_text(e1) + " J";
    });
  }

  static constexpr std::string_view kOfEnergy =
      "(h |w x L|)^2 over the least moment: second order of torque and turn; (h |w|)^3 / 12 |w x L|; and rounding";
  static constexpr std::string_view kOrigin =
      "1/2 h |w x L|: half of what a step without the gyroscopic torque changes; and rounding";
  double substeps_;
  std::uint64_t too_fast_ = 0;
  Tally tally_{"gyroscopic", "angular momenta of free flight", kOrigin};
};

std::string why_not_gyroscopic(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kBodies)); !text.empty()) return text;
  return subject.header.scene.motion == core::Motion::kTranslate ? "the scene's bodies translate only" : "";
}

}  // namespace

ValidatorRow gyroscopic_row() {
  return {"gyroscopic",
          "a body that touches nothing keeps its angular momentum",
          "no gyroscopic torque; a sphere's inertia for a brick; w + 1 %/s",
          core::bit(core::Group::kBodies),
          0,
          why_not_gyroscopic,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Gyroscopic>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
