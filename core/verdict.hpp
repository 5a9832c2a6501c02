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

// For "the worst of": a fail outweighs an inconclusive verdict, that a pass, and a pass one that did not apply.
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

// What a law is about. Coverage is counted by it.
enum class LawKind {
  kTrace,      // the record itself: pairs, digests, states that can be
  kMethod,     // the published method, of traces that declare it
  kMechanics,  // rigid bodies, of any engine
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
  double limit = 0.0;       // what it may be at most (or at least: the origin says)
  std::string unit;         // "", "m", "J", "rad", "pairs"
  std::string origin;       // where the limit comes from, one sentence
  std::string explanation;  // what was checked, or why it does not apply, or what failed: one sentence
  Place worst;
  std::uint64_t checked = 0;  // how many things were judged
  std::uint64_t violations = 0;
  std::string baseline;  // label of the trace that this was judged against; empty = alone

  std::string law;  // what holds, one sentence
  LawKind kind = LawKind::kTrace;
  // Whether the law says how forces move bodies; and how many of the things that were judged were bodies that moved. A
  // time counts only where such a law passed on one.
  bool ties_motion_to_forces = false;
  std::uint64_t moved = 0;
  // The laws that this verdict sums up, where they are several; each has its own worst place and counts.
  std::vector<Verdict> parts;
};

// Whether it ties the motion of at least one body that moved to the forces on it.
inline bool proves_motion(const Verdict& v) {
  return v.ties_motion_to_forces && v.outcome == Outcome::kPass && v.moved > 0;
}

}  // namespace broadside::core
