#include "validation/energy.hpp"

#include <cmath>

#include "validation/energy_ledger.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class Energy final : public Validator {
 public:
  explicit Energy(const Subject& subject) : ledger_(subject.header.scene) {}

  void look(const Evidence& evidence) override {
    const auto row = ledger_.row(evidence.frame, evidence.previous);
    if (!row) return;
    tally_.check(std::abs(row->change - row->sum()),
                 {row->rounding, "J", "the rounding of every stage, as energy: m |v| dv + F dx (float32)"},
                 Where::frame(row->step, "energy"));
    total_.change += row->change;
    total_.integration += row->integration;
    total_.normal += row->normal;
    total_.friction += row->friction;
    total_.correction += row->correction;
    total_.clip += row->clip;
  }

  core::Verdict conclude() override {
    return tally_.conclude("no two consecutive frames",
                           "in all " + number_text(total_.change) + " J: integration " +
                               number_text(total_.integration) + ", normal impulses " + number_text(total_.normal) +
                               ", friction " + number_text(total_.friction) + ", position correction " +
                               number_text(total_.correction) + ", velocity cap " + number_text(total_.clip));
  }

 private:
  EnergyLedger ledger_;
  EnergyRow total_;
  Tally tally_{"energy", "frames", "a frame's change of energy equals the work of its stages, within their rounding"};
};

std::string why_not_energy(const Subject& subject) {
  constexpr std::uint32_t kRead =
      core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) | core::bit(core::Group::kContacts);
  if (std::string text = lacking(subject.header, kRead); !text.empty()) return text;
  if (std::string text = why_not_method(subject.header); !text.empty()) return text;
  if (!subject.header.driver.empty()) return "the states come from another engine";
  if (setting(subject.header.stamp, "solver") != "colored" || setting(subject.header.stamp, "variant") == "printed-E8")
    return "contacts are not applied one after another, so their works do not add up";
  return {};
}

}  // namespace

ValidatorRow energy_row() {
  return {"energy",
          "in every frame, the change of energy equals the work of integration, impulses, friction, correction and cap",
          "a stage whose work is not counted",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) | core::bit(core::Group::kContacts),
          0,
          why_not_energy,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Energy>(subject); }};
}

}  // namespace broadside::validation
