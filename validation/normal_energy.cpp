#include "validation/normal_energy.hpp"

#include <cmath>

#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class NormalEnergy final : public Validator {
 public:
  explicit NormalEnergy(const Subject& subject) : bodies_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    for (const core::Contact& contact : evidence.frame.contacts) {
      const auto app = bodies_.application(contact);
      if (app) judge(*app, evidence.frame.step);
    }
  }

  core::Verdict conclude() override {
    return tally_.conclude("no contacts", "normal impulses took " + number_text(-gained_j_) + " J in all");
  }

 private:
  void judge(const Application& app, std::uint64_t step) {
    const core::Contact& c = *app.contact;
    const double after_error = app.approach_after_rounding();
    const double before = app.approach_before;
    const double after = app.approach_after;

    const double gain = 0.5 * (after - before) * (after + before) / app.w_sum;
    gained_j_ += gain;
    const double error = 2.0 * (app.approach_rounding() + rounding(4) * std::abs(before)) + after_error;
    const double gain_limit = std::abs(after) * error / app.w_sum;
    tally_.check(gain,
                 {gain_limit, "J", "|v_n'| E / (wA + wB), E = 2 times 8 operations on v_n and the additions (float32)"},
                 Where::pair(step, c.a, c.b, "contact.post.v"));

    const double impulse = (after - before) / app.w_sum;
    const double impulse_limit = after_error / app.w_sum + rounding(4) * std::abs(impulse);
    tally_.check(std::abs(c.normal_impulse_n_s - impulse),
                 {impulse_limit, "N s",
                  "the recorded impulse accounts for the change of v_n, within the rounding "
                  "of its additions (float32)"},
                 Where::pair(step, c.a, c.b, "contact.normal_impulse"));
    tally_.check(-static_cast<double>(c.normal_impulse_n_s), {0.0, "N s", "a contact only pushes: J_n >= 0 (METHOD 6)"},
                 Where::pair(step, c.a, c.b, "contact.normal_impulse"));
  }

  ContactBodies bodies_;
  Tally tally_{"normal-energy", "energies and impulses", "METHOD 6 and E5: e <= 1, floor up to the neutral impulse"};
  double gained_j_ = 0.0;
};

std::string why_not_normal_energy(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow normal_energy_row() {
  return {"normal-energy",
          "the normal impulse never adds kinetic energy, and the recorded impulse accounts for the change of velocity",
          "printed-E5",
          core::bit(core::Group::kContacts),
          0,
          why_not_normal_energy,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<NormalEnergy>(subject); }};
}

}  // namespace broadside::validation
