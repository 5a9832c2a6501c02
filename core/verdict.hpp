// What a validator found in a trace.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::core {

enum class Outcome { kPass, kFail, kInconclusive, kNotApplicable };

constexpr std::string_view outcome_word(Outcome o) {
  switch (o) {
    case Outcome::kPass:
      return "pass";
    case Outcome::kFail:
      return "fail";
    case Outcome::kInconclusive:
      return "inconclusive";
    case Outcome::kNotApplicable:
      return "not applicable";
  }
  return "unknown";
}

// For "the worst of": fail is worse than inconclusive, inconclusive than pass, and pass than not applicable.
constexpr int severity(Outcome o) {
  switch (o) {
    case Outcome::kFail:
      return 3;
    case Outcome::kInconclusive:
      return 2;
    case Outcome::kPass:
      return 1;
    case Outcome::kNotApplicable:
      return 0;
  }
  return 3;
}

// The subject of a law. Coverage is counted by kind.
enum class LawKind {
  kTrace,      // the record itself: pairs, digests, valid states
  kMethod,     // the published method, for traces that declare it
  kMechanics,  // mechanics of rigid bodies, for any engine
};

constexpr std::string_view law_kind_word(LawKind k) {
  switch (k) {
    case LawKind::kTrace:
      return "trace";
    case LawKind::kMethod:
      return "method";
    case LawKind::kMechanics:
      return "mechanics";
  }
  return "unknown";
}

// Where the measured value was worst.
struct Place {
  std::int64_t step = -1;             // the frame's step; -1 = no single frame
  std::vector<std::uint32_t> bodies;  // faces of the domain as kFirstFace + k
  std::string field;                  // "contact.normal", "pairs"
};

struct Verdict {
  std::string validator;
  Outcome outcome = Outcome::kNotApplicable;
  double measured = 0.0;    // the worst value, in `unit`
  double limit = 0.0;       // the largest allowed value (or the smallest: the origin says)
  std::string unit;         // "", "m", "J", "rad", "pairs"
  std::string origin;       // where the limit comes from, one sentence
  std::string explanation;  // one sentence: what was checked, why it does not apply, or what failed
  Place worst;
  std::uint64_t checked = 0;  // how many things were judged
  std::uint64_t violations = 0;
  std::string baseline;  // label of the trace against which this was judged; empty = none

  std::string law;  // the law itself, one sentence
  LawKind kind = LawKind::kTrace;
  // Whether the law says how forces move bodies; and how many of the judged things were bodies that moved. A time is
  // admitted only where such a law passed on a moving body.
  bool ties_motion_to_forces = false;
  std::uint64_t moved = 0;
  // The laws that this verdict sums up, when there are several; each has its own worst place and counts.
  std::vector<Verdict> parts;
};

// Whether the verdict ties the motion of at least one moving body to the forces on it.
inline bool proves_motion(const Verdict& v) {
  return v.ties_motion_to_forces && v.outcome == Outcome::kPass && v.moved > 0;
}

}  // namespace broadside::core
