#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>

#include "validation/mechanics/motion.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// h |w|, rad. The error of a method of order p grows with the power p of it, which is no longer small beyond this.
constexpr double kLargestUsefulTurn = 1.0;

class Turning final : public Validator {
 public:
  explicit Turning(const Subject& subject)
      : substeps_(subject.header.declaration.number("substeps")), turns_(subject.header.declaration.turns()) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) {
      if (m.bodies[i].is_alone && m.bodies[i].is_torque_free) judge(m, i);
      if (!turns_ && m.facts[i].is_dynamic) judge_held(m, i);
    }
  }

  core::Verdict conclude() override {
    std::string note;
    if (too_fast_ > 0)
      note = "warning: in " + std::to_string(too_fast_) + " cases a body turned by more than 1 rad a step (at most " +
             number_text(fastest_) + "), too far for any step to follow: use a smaller dt";
    return tally_.conclude("no moving body was free of contact for a whole step", note);
  }

 private:
  // For an engine that declares that its bodies translate.
  void judge_held(const Motion& m, std::uint32_t i) {
    const double angle = angle_of(m.bodies[i].after.q * conjugate(m.bodies[i].before.q));
    tally_.check(angle, {m.rounding_of(16), "rad", "declared: bodies translate, and keep their orientation"},
                 Where::body(m.step, i, "bodies.orientation"));
  }

  void judge(const Motion& m, std::uint32_t i) {
    const BodyState& s0 = m.bodies[i].before;
    const BodyState& s1 = m.bodies[i].after;
    const double turn = m.h * std::max(length(s0.w), length(s1.w));
    if (turn > kLargestUsefulTurn) {
      ++too_fast_;
      fastest_ = std::max(fastest_, turn);
    }
    const double change = m.h * length(s1.w - s0.w);
    // Quaternions: four rounded components each; and the operations that turn and normalize them.
    const double rounding = substeps_ * (m.rounding_of(24) + m.rounding_of(8) * turn);
    const double limit = change + turn * turn * turn / 12.0 + rounding;
    const Quatd actual = s1.q * conjugate(s0.q);
    if (limit < std::numbers::pi) {
      const double error = angle_of(conjugate(turn_by(m.h * s0.w)) * actual);
      tally_.check(error, {limit, "rad", kOrigin}, Where::body(m.step, i, "bodies.orientation"), [&] {
        return "the body turned by " + number_text(angle_of(actual)) + " rad, h |w| = " + number_text(turn) + " rad";
      });
      return;
    }
    // The body turns so fast that no angle follows from w. But its orientation cannot stay the same, unless it makes
    // whole turns.
    const double rest = std::abs(std::sin(0.5 * turn));
    if (rest <= m.rounding_of(16) * turn) return;
    tally_.require(angle_of(actual) > 0.0, "a body that spins does not keep its orientation bit by bit",
                   Where::body(m.step, i, "bodies.orientation"));
  }

  static constexpr std::string_view kOrigin =
      "h |w1 - w0| for the choice between w0 and w1, (h |w|)^3 / 12 for a normalized first-order turn, and rounding";
  double substeps_;
  bool turns_;
  std::uint64_t too_fast_ = 0;
  double fastest_ = 0.0;
  Tally tally_{"turning", "orientations of free flight", kOrigin};
};

}  // namespace

ValidatorRow turning_row() {
  return {"turning",
          "a body that touches nothing turns by h times its angular velocity",
          "orientation at half rate; a frozen orientation; turning backward",
          core::bit(core::Group::kBodies),
          0,
          [](const Subject& subject) { return lacking(subject.header, core::bit(core::Group::kBodies)); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Turning>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
