#include "validation/restitution.hpp"

#include <algorithm>
#include <cmath>

#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class Restitution final : public Validator {
 public:
  explicit Restitution(const Subject& subject)
      : parameters_(subject.header.scene.parameters), bodies_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    for (const core::Contact& contact : evidence.frame.contacts) {
      const auto app = bodies_.application(contact);
      if (app) judge(*app, Where::pair(evidence.frame.step, contact.a, contact.b, "contact.post.v"));
    }
  }

  core::Verdict conclude() override {
    const std::string notes = std::to_string(floored_) + " more are governed by the impulse floor";
    return tally_.conclude(floored_ > 0 ? "no contact without the impulse floor" : "no contacts", notes);
  }

 private:
  void judge(const Application& app, const Where& where) {
    const double band = app.approach_rounding();
    const double v_n = app.approach_before;
    if (std::isnan(v_n)) {
      tally_.check(v_n, {0.0, "m/s", "velocities are numbers"}, where);
      return;
    }
    const bool may_separate = v_n >= -band;
    const bool may_approach = v_n < band;
    const bool may_bounce = -v_n >= parameters_.v_threshold_m_s - band;
    const bool may_stop = -v_n < parameters_.v_threshold_m_s + band;

    // The impulse that P(17) asks for; the floor takes over strictly below J_min.
    const double e_least = may_stop ? 0.0 : app.surface.restitution;
    const double impulse = (1.0 + e_least) * std::max(0.0, -v_n) / app.w_sum;
    const double impulse_rounding = rounding(4) * impulse + (1.0 + e_least) * band / app.w_sum;
    if (may_approach && impulse + impulse_rounding < parameters_.impulse_min_n_s) {
      // Inside the band a contact may also have counted as separating, and then nothing may change.
      if (!(may_separate && app.approach_after == app.approach_before)) {
        ++floored_;
        return;
      }
    }
    if (may_approach && impulse - impulse_rounding < parameters_.impulse_min_n_s && !may_separate) {
      tally_.leave_undecided();
      return;
    }

    double error = std::numeric_limits<double>::infinity();
    const auto allow = [&](double expected) { error = std::min(error, std::abs(app.approach_after - expected)); };
    if (may_separate) allow(v_n);
    if (may_approach && may_bounce) allow(-app.surface.restitution * v_n);
    if (may_approach && may_stop) allow(0.0);
    if (std::isnan(app.approach_after)) error = app.approach_after;
    const double e = may_bounce ? app.surface.restitution : 0.0;
    const double limit =
        may_approach ? (1.0 + e) * (band + rounding(4) * std::abs(v_n)) + app.approach_after_rounding() : 0.0;
    tally_.check(error,
                 {limit, "m/s",
                  may_approach ? "(1 + e) times 8 operations on v_n, and the additions to both velocities (float32)"
                               : "a separating contact changes nothing (METHOD 6)"},
                 where);
  }

  core::Parameters parameters_;
  ContactBodies bodies_;
  Tally tally_{"restitution", "contact applications", "METHOD 6, P(17): v_n' = -e_eff v_n"};
  std::uint64_t floored_ = 0;
};

std::string why_not(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method_response(subject.header);
}

}  // namespace

ValidatorRow restitution_row() {
  return {"restitution",
          "contacts leave with -e_eff times the normal speed they came with; separating ones are untouched",
          "restitution applied below the threshold speed",
          core::bit(core::Group::kContacts),
          0,
          why_not,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Restitution>(subject); }};
}

}  // namespace broadside::validation
