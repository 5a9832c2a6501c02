#include "validation/determinism.hpp"

#include <optional>

#include "core/trace/frame_difference.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kDeterminismOrigin = "same stamp, same bits, on any thread count and device (DESIGN 8)";
constexpr std::uint32_t kAllGroups = core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) |
                                     core::bit(core::Group::kPairs) | core::bit(core::Group::kConfirmed) |
                                     core::bit(core::Group::kContacts) | core::bit(core::Group::kNarrow) |
                                     core::bit(core::Group::kPoints) | core::bit(core::Group::kDetectedOrientation);

// The first field that differs by bits; where none does, the digests if they differ.
std::optional<Where> divergence(const core::FrameRecord& a, const core::FrameRecord& b, std::uint32_t groups) {
  const auto first = core::first_difference(a, b, groups, core::Bookkeeping::kIgnored);
  if (first) return Where{a.step, first->body_count, {first->bodies[0], first->bodies[1]}, first->field};
  if (a.digest != b.digest) return Where::frame(a.step, "/trace/digest");
  return std::nullopt;
}

class Determinism final : public Validator {
 public:
  explicit Determinism(const Subject& subject)
      : baseline_(subject.baseline->stamp.label()),
        // A reader of states gets them in float64 where a trace has them, so these are compared too.
        common_(subject.header.groups & subject.baseline->groups & (kAllGroups | core::bit(core::Group::kWideBodies))) {
  }

  void look(const Evidence& evidence) override {
    if (evidence.baseline == nullptr) {
      ++alone_;
      return;
    }
    const core::FrameRecord& frame = evidence.frame;
    const std::optional<Where> where = divergence(frame, *evidence.baseline, common_);
    tally_.check(where ? 1.0 : 0.0, {0.0, "frames", kDeterminismOrigin},
                 where.value_or(Where::frame(frame.step, "/trace/digest")));
  }

  core::Verdict conclude() override {
    std::string notes;
    if (alone_ > 0) notes = std::to_string(alone_) + " frames have no counterpart in the baseline";
    core::Verdict verdict = tally_.conclude("the two traces share no step", notes);
    verdict.baseline = baseline_;
    return verdict;
  }

 private:
  std::string baseline_;
  std::uint32_t common_;
  Tally tally_{"determinism", "frames", kDeterminismOrigin};
  std::uint64_t alone_ = 0;
};

std::string why_not_determinism(const Subject& subject) {
  if (subject.baseline == nullptr) return "no second run of the same stamp was given";
  const core::Stamp& a = subject.header.stamp;
  const core::Stamp& b = subject.baseline->stamp;
  if (!are_twins(subject.header, *subject.baseline)) return "the baseline is another engine (" + b.engine + ")";
  if (!same_settings_but(a, b, {"threads"})) return "the baseline has other settings (" + b.label() + ")";
  if (subject.header.driver != subject.baseline->driver) return "the two were fed by different engines";
  return {};
}

}  // namespace

ValidatorRow determinism_row() {
  return {"determinism",
          "a second run of the same stamp has the same digests and fields, frame by frame",
          "printed-E8; one flipped bit",
          kAllGroups,
          kAllGroups,
          why_not_determinism,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Determinism>(subject); }};
}

}  // namespace broadside::validation
