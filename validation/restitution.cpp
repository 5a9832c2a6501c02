#include "validation/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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
    std::string notes = std::to_string(floored_) + " governed by the impulse floor";
    if (beyond_ > 0) notes += ", " + std::to_string(beyond_) + " more above the neutral impulse (normal-energy)";
    return tally_.conclude("no contacts", notes);
  }

 private:
  // One of the speeds that rounding leaves open for the end of a contact.
  struct Answer {
    double after = 0.0;
    Limit limit;
    bool is_floor = false;
  };

  void judge(const Application& app, const Where& where) {
    const double band = app.approach_rounding();
    const double v_n = app.approach_before;
    if (std::isnan(v_n) || std::isnan(app.approach_after)) {
      tally_.check(app.approach_after + v_n, {0.0, "m/s", "velocities are numbers"}, where);
      return;
    }
    answers_.clear();
    if (v_n >= -band) answers_.push_back({v_n, {0.0, "m/s", "a separating contact changes nothing (METHOD 6)"}});
    if (v_n < band) {
      if (-v_n >= parameters_.v_threshold_m_s - band) allow_bounce(app, app.surface.restitution);
      if (-v_n < parameters_.v_threshold_m_s + band) allow_bounce(app, 0.0);
    }
    judge_answers(app, where);
  }

  // P(17) with this e, or where that impulse is below the floor, the floor: P(18) up to the neutral impulse (E5).
  void allow_bounce(const Application& app, double e) {
    const double v_n = app.approach_before;
    const double band = app.approach_rounding();
    const double impulse = (1.0 + e) * std::max(0.0, -v_n) / app.w_sum;
    const double impulse_rounding = rounding(4) * impulse + (1.0 + e) * band / app.w_sum;
    const double neutral = 2.0 * std::max(0.0, -v_n) / app.w_sum;
    const double least = parameters_.impulse_min_n_s;
    const double floor = std::min(least, neutral);
    const double change_rounding = band + rounding(4) * std::abs(v_n);
    const double after_rounding = app.approach_after_rounding();
    if (impulse + impulse_rounding >= floor)
      answers_.push_back({-e * v_n,
                          {(1.0 + e) * change_rounding + after_rounding, "m/s",
                           "(1 + e) times 8 operations on v_n, and the additions to both velocities (float32)"}});
    if (impulse - impulse_rounding >= least) return;
    // The floor itself is a parameter and does not round; the neutral impulse is that of e = 1.
    const double floor_rounding = least < neutral ? 0.0 : 2.0 * change_rounding;
    answers_.push_back({v_n + floor * app.w_sum,
                        {floor_rounding + rounding(1) * floor * app.w_sum + after_rounding, "m/s",
                         "P(18), E5: the smaller of J_min and the neutral impulse, to the additions (float32)"},
                        true});
  }

  // The answer that is nearest to its limit, or least beyond it, stands for the contact. There is at least one.
  void judge_answers(const Application& app, const Where& where) {
    const Answer* best = &answers_.front();
    double best_off = std::abs(app.approach_after - best->after);
    bool may_be_floor = false;
    for (const Answer& answer : answers_) {
      may_be_floor = may_be_floor || answer.is_floor;
      const double off = std::abs(app.approach_after - answer.after);
      if (!(off - answer.limit.value < best_off - best->limit.value)) continue;
      best = &answer;
      best_off = off;
    }
    const bool is_neutral_broken = app.approach_after > std::abs(app.approach_before) + best->limit.value;
    if (may_be_floor && is_neutral_broken) {
      ++beyond_;
      return;
    }
    floored_ += best->is_floor ? 1 : 0;
    tally_.check(best_off, best->limit, where);
  }

  core::Parameters parameters_;
  ContactBodies bodies_;
  Tally tally_{"restitution", "contact applications", "METHOD 6, P(17): v_n' = -e_eff v_n"};
  std::vector<Answer> answers_;
  std::uint64_t floored_ = 0;
  std::uint64_t beyond_ = 0;
};

std::string why_not_restitution(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow restitution_row() {
  return {"restitution",
          "contacts separate at -e_eff times their approach speed, or at the speed that the impulse floor gives; "
          "separating contacts stay unchanged",
          "restitution applied below the threshold speed; an impulse below the floor",
          core::bit(core::Group::kContacts),
          0,
          why_not_restitution,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Restitution>(subject); }};
}

}  // namespace broadside::validation
