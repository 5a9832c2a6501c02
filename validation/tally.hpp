// Counts what one validator judged, keeps the worst place, and words the verdict.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/trace/trace_header.hpp"
#include "core/verdict.hpp"

namespace broadside::validation {

// A limit is never a bare number: it carries its unit and where it comes from. Both texts have static storage.
struct Limit {
  double value = 0.0;
  std::string_view unit;
  std::string_view origin;
};

// Where something was judged. Field: a path into the frame such as "contact.normal", static storage.
struct Where {
  std::uint64_t step = 0;
  std::uint32_t body_count = 0;
  std::uint32_t bodies[2] = {0, 0};
  std::string_view field;

  static constexpr Where frame(std::uint64_t step, std::string_view field) { return {step, 0, {0, 0}, field}; }
  static constexpr Where body(std::uint64_t step, std::uint32_t body, std::string_view field) {
    return {step, 1, {body, 0}, field};
  }
  static constexpr Where pair(std::uint64_t step, std::uint32_t a, std::uint32_t b, std::string_view field) {
    return {step, 2, {a, b}, field};
  }
};

// "1.23e-05": short enough for one sentence.
std::string number_text(double value);

// "body 3", "the -y face": for sentences.
std::string body_text(std::uint32_t body);

class Tally {
 public:
  // validator, things ("contact applications") and default origin: static storage.
  Tally(std::string_view validator, std::string_view things, std::string_view origin)
      : validator_(validator), things_(things), origin_(origin) {}

  // Judges that measured <= limit; NaN breaks every limit. The worst is the largest measured / limit, the earliest of
  // equals.
  // worked: the numbers behind it, asked for when this becomes the worst value; a failing verdict shows them.
  bool check(double measured, const Limit& limit, const Where& where, const std::function<std::string()>& worked = {});
  // The same for a value of which only an upper bound is known. Returns true, and counts the value as judged, when the
  // bound alone shows that the value holds its limit and is no worse than the worst so far. Otherwise nothing is
  // judged, and the value itself has to be measured.
  bool check_bound(double bound, double limit);
  // A law that either holds or not, without a magnitude.
  bool require(bool holds, std::string_view origin, const Where& where);
  // The law applies here, but rounding alone decides the answer.
  void leave_undecided() { ++undecided_; }
  // What was just judged was a body that moved (Verdict::moved).
  void note_moved() { ++moved_; }
  // Takes over what another tally counted. Of two worst values that are equally bad, the one of the earlier step stays.
  void absorb(const Tally& other);

  [[nodiscard]] std::uint64_t checked() const { return checked_; }
  [[nodiscard]] std::uint64_t violations() const { return violations_; }
  [[nodiscard]] std::uint64_t undecided() const { return undecided_; }

  // Fail with any violation; pass with any check; inconclusive when only undecided things were met; otherwise not
  // applicable, saying `nothing` ("no contacts"). `notes` is appended to the sentence of what was judged.
  [[nodiscard]] core::Verdict conclude(std::string_view nothing, const std::string& notes = {}) const;

 private:
  std::string_view validator_;
  std::string_view things_;
  std::string_view origin_;
  std::uint64_t checked_ = 0;
  std::uint64_t violations_ = 0;
  std::uint64_t undecided_ = 0;
  std::uint64_t moved_ = 0;
  double worst_ratio_ = -1.0;
  double worst_measured_ = 0.0;
  Limit worst_limit_;
  Where worst_where_;
  Where first_violation_;
  std::string worst_worked_;
};

}  // namespace broadside::validation
