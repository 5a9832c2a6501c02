#include <algorithm>

#include "validation/mechanics/motion.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Roundings of a recorded velocity: one of the record, one of the step's sum, and the 5 of a turn (3 products, 2 sums)
// in engines that hold velocities in the body's axes.
constexpr double kOfAVelocity = 7.0;

class Ballistic final : public Validator {
 public:
  explicit Ballistic(const Subject& subject)
      : is_method_(subject.header.declaration.follows_method()),
        substeps_(subject.header.declaration.number("substeps")),
        v_max_(subject.header.scene.parameters.v_max_m_s) {}

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr) return;
    const Motion& m = *evidence.motion;
    for (std::uint32_t i = 0; i < m.bodies.size(); ++i) {
      const BodyStep& b = m.bodies[i];
      if (!b.is_alone || m.facts[i].has_spring) continue;
      for (int k = 0; k < 3; ++k) judge(m, i, b, k);
      if (has_moved(b)) tally_.note_moved();
    }
  }

  core::Verdict conclude() override { return tally_.conclude("no moving body was free of contact for a whole step"); }

 private:
  // v1 - v0 = g h + F h / m, and x1 - x0 within h times the velocities that the step had: RIGID 5.
  void judge(const Motion& m, std::uint32_t i, const BodyStep& b, int k) {
    const double v0 = b.before.v[k];
    const double v1 = b.after.v[k];
    const double pull = m.h * b.acceleration[k];
    // METHOD clips velocities, P(23).
    const bool is_clipped = is_method_ && std::abs(v0 + pull) >= v_max_;
    // An engine may hold velocities in the body's axes: then each component is rounded relative to the whole velocity.
    const double off_v = substeps_ * (m.rounding_of(6) * m.h * length(b.acceleration) +
                                      m.rounding_of(kOfAVelocity) * (length(b.before.v) + length(b.after.v))) +
                         kSubnormal + m.h * b.acceleration_slack;
    const auto worked = [&] {
      return "dv = " + number_text(v1 - v0) + " m/s, g h + F h / m = " + number_text(pull) +
             " m/s; dx = " + number_text(b.after.x[k] - b.before.x[k]) + " m, h v = " + number_text(m.h * v0) + " to " +
             number_text(m.h * v1) + " m";
    };
    if (!is_clipped)
      tally_.check(std::abs(v1 - v0 - pull), {off_v, "m/s", kOrigin}, Where::body(m.step, i, "bodies.velocity"),
                   worked);
    // METHOD clips after it moved.
    const double last = is_clipped ? v0 + pull : v1;
    const double low = m.h * std::min(v0, last);
    const double high = m.h * std::max(v0, last);
    const double dx = b.after.x[k] - b.before.x[k];
    const double offset = length(m.facts[i].center_of_mass);
    const double off_x =
        substeps_ * (m.rounding_of(2) * (std::abs(b.before.x[k]) + std::abs(b.after.x[k]) + 12 * offset) +
                     m.rounding_of(4) * (std::abs(low) + std::abs(high))) +
        m.h * off_v + kSubnormal;
    tally_.check(std::max({0.0, low - dx, dx - high}), {off_x, "m", kOrigin}, Where::body(m.step, i, "bodies.position"),
                 worked);
  }

  static constexpr std::string_view kOrigin = "rounding of the recorded states, a few operations a substep";
  bool is_method_;
  double substeps_;
  double v_max_;
  Tally tally_{"ballistic", "components of free flight", kOrigin};
};

}  // namespace

ValidatorRow ballistic_row() {
  return {"ballistic",
          "a body that touches nothing gains g h + F h / m of velocity, and moves h times a velocity between its first "
          "and last",
          "gravity + 10 %; damping; a teleport; an engine that does nothing",
          core::bit(core::Group::kBodies),
          0,
          [](const Subject& subject) { return lacking(subject.header, core::bit(core::Group::kBodies)); },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Ballistic>(subject); },
          false,
          true,
          true};
}

}  // namespace broadside::validation
