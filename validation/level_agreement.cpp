#include "validation/level_agreement.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <vector>

#include "core/scene/shapes.hpp"
#include "validation/overlap_join.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kLevelAgreementOrigin =
    "METHOD 2: a child box lies inside its parent's box; boxes are compared as floats";

// The last level whose boxes are tested; nothing when the settings do not say.
std::optional<int> last_level(const core::Stamp& stamp) {
  const std::string_view levels = setting(stamp, "levels");
  if (levels == "flat") return 0;
  if (levels == "level1") return 1;
  if (levels == "A" || levels == "B" || levels == "C") return 2;
  return std::nullopt;
}

bool meet(const core::Box& a, core::Vec3 xa, const core::Box& b, core::Vec3 xb) {
  return !core::is_empty(a) && !core::is_empty(b) && core::overlaps(core::translated(a, xa), core::translated(b, xb));
}

// Do boxes of `level` below these two nodes overlap? Descends only where parents do, which loses nothing.
bool meet_at(int level, const core::BodyOctree& a, int node_a, core::Vec3 xa, const core::BodyOctree& b, int node_b,
             core::Vec3 xb) {
  if (!meet(a.boxes[node_a], xa, b.boxes[node_b], xb)) return false;
  if (level == 0) return true;
  for (int p = core::first_child(node_a); p < core::first_child(node_a) + 8; ++p) {
    if (!meet(a.boxes[p], xa, b.boxes[node_b], xb)) continue;
    for (int q = core::first_child(node_b); q < core::first_child(node_b) + 8; ++q)
      if (meet_at(level - 1, a, p, xa, b, q, xb)) return true;
  }
  return false;
}

class LevelAgreement final : public Validator {
 public:
  explicit LevelAgreement(const Subject& subject)
      : header_(subject.header), shapes_(core::build_shapes(header_.scene)), level_(last_level(header_.stamp)) {
    for (const core::Body& body : header_.scene.bodies) is_static_.push_back(body.inverse_mass > 0.0F ? 0 : 1);
    if (subject.baseline == nullptr || !level_) return;
    const core::TraceHeader& base = *subject.baseline;
    constexpr std::uint32_t kBoth = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
    if (!are_twins(base, header_) || !lacking(base, kBoth).empty()) return;
    if (!same_settings_but(base.stamp, header_.stamp, {"broad", "levels", "threads"})) return;
    baseline_level_ = last_level(base.stamp);
    baseline_ = base.stamp.label();
  }

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    if (level_ && frame.detected_position.size() == is_static_.size()) recompute(frame);
    if (baseline_level_ && evidence.baseline != nullptr) compare(frame, *evidence.baseline);
  }

  core::Verdict conclude() override {
    std::string notes = std::to_string(recomputed_) + " frames recomputed";
    if (compared_ > 0 || parted_ > 0) {
      notes += ", " + std::to_string(compared_) + " compared with the baseline";
      if (parted_ > 0) notes += ", " + std::to_string(parted_) + " not: their boxes differ";
    }
    core::Verdict verdict = tally_.conclude("no frames", notes);
    if (compared_ > 0) verdict.baseline = baseline_;
    return verdict;
  }

 private:
  void recompute(const core::FrameRecord& frame) {
    ++recomputed_;
    const bool has_candidates = has(header_, core::Group::kPairs);
    const std::vector<core::Pair>& start = has_candidates ? frame.pairs : join_.join(frame.boxes, is_static_);
    expected_.clear();
    for (const core::Pair p : start) {
      if (p.i >= is_static_.size() || p.j >= is_static_.size()) continue;
      if (is_expected(frame, p)) expected_.push_back(p);
    }
    last_position_ = frame.detected_position;
    last_start_.assign(start.begin(), start.end());
    last_expected_ = expected_;
    judge(expected_, frame.confirmed, frame.step, "confirmed: lost");
    judge(frame.confirmed, expected_, frame.step, "confirmed: too many");
  }

  // A pair that has not moved since the frame before has that frame's answer.
  bool is_expected(const core::FrameRecord& frame, core::Pair p) const {
    const auto& x = frame.detected_position;
    const auto is_in = [p](const std::vector<core::Pair>& pairs) {
      return std::binary_search(pairs.begin(), pairs.end(), p);
    };
    const bool has_moved =
        last_position_.empty() || !(last_position_[p.i] == x[p.i]) || !(last_position_[p.j] == x[p.j]);
    if (!has_moved && is_in(last_start_)) return is_in(last_expected_);
    const core::BodyOctree& a = shapes_.shapes[shapes_.shape_of_body[p.i]].octree;
    const core::BodyOctree& b = shapes_.shapes[shapes_.shape_of_body[p.j]].octree;
    return meet_at(*level_, a, 0, x[p.i], b, 0, x[p.j]);
  }

  void compare(const core::FrameRecord& frame, const core::FrameRecord& baseline) {
    if (baseline.boxes != frame.boxes) {
      ++parted_;
      return;
    }
    ++compared_;
    // A setting with a shallower last level confirms at least as many pairs.
    if (*level_ >= *baseline_level_)
      judge(frame.confirmed, baseline.confirmed, frame.step, "confirmed: not in the baseline");
    if (*level_ <= *baseline_level_)
      judge(baseline.confirmed, frame.confirmed, frame.step, "confirmed: only in the baseline");
  }

  // Every pair of `inner` is in `outer`.
  void judge(const std::vector<core::Pair>& inner, const std::vector<core::Pair>& outer, std::uint64_t step,
             std::string_view field) {
    difference_.clear();
    std::set_difference(inner.begin(), inner.end(), outer.begin(), outer.end(), std::back_inserter(difference_));
    const Where where = difference_.empty() ? Where::frame(step, field)
                                            : Where::pair(step, difference_.front().i, difference_.front().j, field);
    tally_.check(static_cast<double>(difference_.size()), {0.0, "pairs", kLevelAgreementOrigin}, where);
  }

  const core::TraceHeader& header_;
  core::ShapeTable shapes_;
  std::optional<int> level_;
  std::optional<int> baseline_level_;
  std::string baseline_;
  std::vector<std::uint8_t> is_static_;
  OverlapJoin join_;
  std::vector<core::Pair> expected_;
  std::vector<core::Pair> difference_;
  // Of the frame before.
  std::vector<core::Vec3> last_position_;
  std::vector<core::Pair> last_start_;
  std::vector<core::Pair> last_expected_;
  Tally tally_{"level-agreement", "lists of confirmed pairs", kLevelAgreementOrigin};
  std::uint64_t recomputed_ = 0;
  std::uint64_t compared_ = 0;
  std::uint64_t parted_ = 0;
};

std::string why_not_level_agreement(const Subject& subject) {
  constexpr std::uint32_t kBoth = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
  if (std::string text = lacking(subject.header, kBoth); !text.empty()) return text;
  if (has(subject.header, core::Group::kDetectedOrientation)) return "its body octrees turn with the bodies";
  return last_level(subject.header.stamp) ? "" : "the settings name no body-octree levels";
}

}  // namespace

ValidatorRow level_agreement_row() {
  constexpr std::uint32_t kRead = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
  return {
      "level-agreement",
      "levels A, B and C confirm the same pairs, those whose last-level boxes overlap; level1 and flat confirm at "
      "least these",
      "a wrongly skipped child",
      kRead | core::bit(core::Group::kPairs),
      kRead,
      why_not_level_agreement,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<LevelAgreement>(subject); }};
}

}  // namespace broadside::validation
