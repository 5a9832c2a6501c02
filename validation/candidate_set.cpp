#include "validation/candidate_set.hpp"

#include <algorithm>
#include <iterator>

#include "validation/overlap_join.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kExactOrigin = "P(6) on the recorded boxes: comparing floats does not round";

class CandidateSet final : public Validator {
 public:
  explicit CandidateSet(const Subject& subject) : header_(subject.header) {
    for (const core::Body& body : header_.scene.bodies) is_static_.push_back(body.inverse_mass > 0.0F ? 0 : 1);
    constexpr std::uint32_t kBoth = core::bit(core::Group::kPairs) | core::bit(core::Group::kDetection);
    if (subject.baseline != nullptr && lacking(*subject.baseline, kBoth).empty())
      baseline_ = subject.baseline->stamp.label();
  }

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    if (frame.boxes.size() != is_static_.size()) {
      tally_.require(false, "one box per body", Where::frame(frame.step, "boxes"));
      return;
    }
    raw_ += frame.pairs_raw;
    if (!judge_form(frame)) return;
    const std::vector<core::Pair>& exact = join_.join(frame.boxes, is_static_);
    pairs_ += exact.size();
    compare(frame.pairs, exact, frame.step);
    if (!baseline_.empty() && evidence.baseline != nullptr) compare_with(*evidence.baseline, frame);
  }

  core::Verdict conclude() override {
    std::string notes = std::to_string(pairs_) + " overlapping pairs in all";
    if (missed_ > 0) notes += ", " + std::to_string(missed_) + " missed";
    if (extra_ > 0) notes += ", " + std::to_string(extra_) + " too many";
    if (malformed_ > 0) notes += ", " + std::to_string(malformed_) + " entries out of order, repeated or impossible";
    if (raw_ > pairs_ && pairs_ > 0)
      notes += "; the engine itself reported " +
               number_text(100.0 * (static_cast<double>(raw_) / static_cast<double>(pairs_) - 1.0)) +
               " % more before filtering";
    if (compared_ > 0)
      notes += "; " + std::to_string(compared_) + " frames compared with the baseline's pairs, " +
               std::to_string(differing_) + " differ";
    core::Verdict verdict = tally_.conclude("no frames", notes);
    if (compared_ > 0) verdict.baseline = baseline_;
    return verdict;
  }

 private:
  // i < j, ids of bodies, strictly rising. One violation per entry that is not.
  bool judge_form(const core::FrameRecord& frame) {
    std::uint64_t wrong = 0;
    Where where = Where::frame(frame.step, "pairs");
    for (std::size_t k = 0; k < frame.pairs.size(); ++k) {
      const core::Pair p = frame.pairs[k];
      if (p.i < p.j && p.j < is_static_.size() && (k == 0 || frame.pairs[k - 1] < p)) continue;
      if (wrong++ == 0) where = Where::pair(frame.step, p.i, p.j, "pairs");
    }
    malformed_ += wrong;
    return tally_.check(static_cast<double>(wrong), {0.0, "pairs", "pairs are sorted, i < j, each once (DESIGN 4)"},
                        where);
  }

  void compare(const std::vector<core::Pair>& found, const std::vector<core::Pair>& exact, std::uint64_t step) {
    difference_.clear();
    if (found == exact) {
      judge_count(step, "pairs missed", kExactOrigin);
      if (header_.broad_is_exact) judge_count(step, "pairs too many", kExactOrigin);
      return;
    }
    std::set_difference(exact.begin(), exact.end(), found.begin(), found.end(), std::back_inserter(difference_));
    missed_ += difference_.size();
    judge_count(step, "pairs missed", kExactOrigin);
    difference_.clear();
    std::set_difference(found.begin(), found.end(), exact.begin(), exact.end(), std::back_inserter(difference_));
    extra_ += difference_.size();
    if (header_.broad_is_exact) judge_count(step, "pairs too many", kExactOrigin);
  }

  // The exact set is the arbiter: a baseline that differs from a right subject is itself wrong, and only reported.
  void compare_with(const core::FrameRecord& baseline, const core::FrameRecord& frame) {
    if (baseline.boxes != frame.boxes) return;
    ++compared_;
    if (baseline.pairs != frame.pairs) ++differing_;
  }

  void judge_count(std::uint64_t step, std::string_view field, std::string_view origin) {
    const Where where = difference_.empty() ? Where::frame(step, field)
                                            : Where::pair(step, difference_.front().i, difference_.front().j, field);
    tally_.check(static_cast<double>(difference_.size()), {0.0, "pairs", origin}, where);
  }

  const core::TraceHeader& header_;
  std::vector<std::uint8_t> is_static_;
  OverlapJoin join_;
  std::vector<core::Pair> difference_;
  Tally tally_{"candidate-set", "pair lists", kExactOrigin};
  std::string baseline_;
  std::uint64_t pairs_ = 0;
  std::uint64_t raw_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t extra_ = 0;
  std::uint64_t malformed_ = 0;
  std::uint64_t compared_ = 0;
  std::uint64_t differing_ = 0;
};

std::string why_not_candidate_set(const Subject& subject) {
  return lacking(subject.header, core::bit(core::Group::kPairs) | core::bit(core::Group::kDetection));
}

}  // namespace

ValidatorRow candidate_set_row() {
  return {"candidate-set",
          "the candidate pairs are exactly the overlapping pairs of the recorded boxes",
          "printed-E2; a dropped pair; a stale pair; a repeated pair",
          core::bit(core::Group::kPairs) | core::bit(core::Group::kDetection),
          core::bit(core::Group::kPairs) | core::bit(core::Group::kDetection),
          why_not_candidate_set,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<CandidateSet>(subject); }};
}

}  // namespace broadside::validation
