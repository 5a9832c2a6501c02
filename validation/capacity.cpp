#include "validation/capacity.hpp"

#include <cmath>

#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class Capacity final : public Validator {
 public:
  explicit Capacity(const Subject&) {}

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    const double missing = static_cast<double>(frame.pairs_demanded) - static_cast<double>(frame.pairs.size());
    tally_.check(std::abs(missing), {0.0, "pairs", "demanded = stored: counts are exact"},
                 Where::frame(frame.step, "pairs"));
    tally_.check(static_cast<double>(frame.pairs.size()) - static_cast<double>(frame.pairs_raw),
                 {0.0, "pairs", "filtering only removes pairs: raw >= stored"}, Where::frame(frame.step, "pairs.raw"));
  }

  core::Verdict conclude() override { return tally_.conclude("no frames"); }

 private:
  Tally tally_{"capacity", "counts of pairs", "demanded = stored: counts are exact"};
};

std::string why_not_capacity(const Subject& subject) {
  return lacking(subject.header, core::bit(core::Group::kPairs));
}

}  // namespace

ValidatorRow capacity_row() {
  return {"capacity",
          "no buffer overflowed silently: as many pairs stored as demanded",
          "a truncated pair list",
          core::bit(core::Group::kPairs),
          0,
          why_not_capacity,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Capacity>(subject); }};
}

}  // namespace broadside::validation
