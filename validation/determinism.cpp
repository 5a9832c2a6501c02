#include "validation/determinism.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kOrigin = "same stamp, same bits, on any thread count and device (DESIGN 8)";
constexpr std::uint32_t kAllGroups = core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection) |
                                     core::bit(core::Group::kPairs) | core::bit(core::Group::kConfirmed) |
                                     core::bit(core::Group::kContacts) | core::bit(core::Group::kNarrow);

template <typename T>
bool same_bits(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// Separation has padding, whose bits mean nothing.
bool same_bits(const core::Separation& a, const core::Separation& b) {
  return same_bits(a.distance_m, b.distance_m) && a.is_touching == b.is_touching && same_bits(a.normal, b.normal) &&
         same_bits(a.witness_a, b.witness_a) && same_bits(a.witness_b, b.witness_b);
}

// Index of the first entry that differs, counting a missing one.
template <typename T>
std::optional<std::size_t> first_difference(const std::vector<T>& a, const std::vector<T>& b) {
  const std::size_t both = std::min(a.size(), b.size());
  for (std::size_t k = 0; k < both; ++k)
    if (!same_bits(a[k], b[k])) return k;
  return a.size() == b.size() ? std::nullopt : std::optional<std::size_t>(both);
}

// Compares in pipeline order, so the first difference is nearest to its cause.
class Divergence {
 public:
  Divergence(const core::FrameRecord& a, const core::FrameRecord& b, std::uint32_t groups)
      : a_(a), b_(b), groups_(groups) {}

  std::optional<Where> find() {
    if (has_group(core::Group::kDetection)) {
      bodies(a_.detected_position, b_.detected_position, "detection.position");
      bodies(a_.detected_velocity, b_.detected_velocity, "detection.velocity");
      bodies(a_.boxes, b_.boxes, "boxes");
    }
    if (has_group(core::Group::kPairs)) pairs(a_.pairs, b_.pairs, "pairs");
    if (has_group(core::Group::kConfirmed)) {
      pairs(a_.confirmed, b_.confirmed, "confirmed");
      of_pair(a_.proximity, b_.proximity, a_.confirmed, "proximity");
    }
    if (has_group(core::Group::kContacts)) contacts();
    if (has_group(core::Group::kBodies)) {
      bodies(a_.position, b_.position, "bodies.position");
      bodies(a_.orientation, b_.orientation, "bodies.orientation");
      bodies(a_.velocity, b_.velocity, "bodies.velocity");
      bodies(a_.angular_velocity, b_.angular_velocity, "bodies.angular_velocity");
    }
    if (has_group(core::Group::kNarrow)) {
      pairs(a_.measured, b_.measured, "measured");
      of_pair(a_.separations, b_.separations, a_.measured, "separations");
    }
    return found_;
  }

 private:
  [[nodiscard]] bool has_group(core::Group g) const { return (groups_ & core::bit(g)) != 0; }

  template <typename T>
  void bodies(const std::vector<T>& a, const std::vector<T>& b, std::string_view field) {
    if (found_) return;
    if (const auto k = first_difference(a, b)) found_ = Where::body(a_.step, static_cast<std::uint32_t>(*k), field);
  }

  void pairs(const std::vector<core::Pair>& a, const std::vector<core::Pair>& b, std::string_view field) {
    if (found_) return;
    const auto k = first_difference(a, b);
    if (!k) return;
    const core::Pair p = *k < a.size() ? a[*k] : b[*k];
    found_ = Where::pair(a_.step, p.i, p.j, field);
  }

  template <typename T>
  void of_pair(const std::vector<T>& a, const std::vector<T>& b, const std::vector<core::Pair>& of,
               std::string_view field) {
    if (found_) return;
    const auto k = first_difference(a, b);
    if (k) found_ = *k < of.size() ? Where::pair(a_.step, of[*k].i, of[*k].j, field) : Where::frame(a_.step, field);
  }

  void contacts() {
    if (found_) return;
    const auto k = first_difference(a_.contacts, b_.contacts);
    if (!k) return;
    const core::Contact& c = *k < a_.contacts.size() ? a_.contacts[*k] : b_.contacts[*k];
    found_ = Where::pair(a_.step, c.a, c.b, "contacts");
  }

  const core::FrameRecord& a_;
  const core::FrameRecord& b_;
  std::uint32_t groups_;
  std::optional<Where> found_;
};

class Determinism final : public Validator {
 public:
  explicit Determinism(const Subject& subject)
      : baseline_(subject.baseline->stamp.label()), common_(subject.header.groups & subject.baseline->groups) {}

  void look(const Evidence& evidence) override {
    if (evidence.baseline == nullptr) {
      ++alone_;
      return;
    }
    const core::FrameRecord& frame = evidence.frame;
    const std::optional<Where> where = Divergence(frame, *evidence.baseline, common_).find();
    const bool same = !where && frame.digest == evidence.baseline->digest;
    tally_.check(same ? 0.0 : 1.0, {0.0, "frames", kOrigin}, where.value_or(Where::frame(frame.step, "digest")));
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
  Tally tally_{"determinism", "frames", kOrigin};
  std::uint64_t alone_ = 0;
};

std::string why_not(const Subject& subject) {
  if (subject.baseline == nullptr) return "no second run of the same stamp was given";
  const core::Stamp& a = subject.header.stamp;
  const core::Stamp& b = subject.baseline->stamp;
  if (!are_twins(a.engine, b.engine)) return "the baseline is another engine (" + b.engine + ")";
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
          why_not,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Determinism>(subject); }};
}

}  // namespace broadside::validation
