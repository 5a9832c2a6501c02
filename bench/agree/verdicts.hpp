// How an engine's answer compares with the arbiter's, and sums of these verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/agree/answers.hpp"
#include "bench/agree/pairs.hpp"
#include "core/engine/equivalence.hpp"

namespace broadside::bench {

// Inside the touching band the sign of the distance is noise, so there an engine only has to answer.
enum class Agreement {
  kAgree,
  kTouchingBand,
  kDistanceOff,  // apart, and the distance is off by more than kTouchingBand_m
  kDepthOff,     // overlapping: the depth is not the least one
  kNormalOff,    // parting the bodies along it takes more than the least depth; or it is not the direction between them
  kConvention,   // the right normal with the opposite sign
  kMissed,       // the engine says apart, and the bodies overlap
  kExtra,        // the engine says touching, and the bodies are apart
  kNoNumber,     // NaN, or touching without depth and direction
  kThrew,
  kAborted,
  kCrashed,
  kTimedOut,
};
inline constexpr std::array<std::string_view, 13> kAgreements{
    "agree", "touching band", "distance off", "depth off", "normal off", "convention", "missed",
    "extra", "no number",     "exception",    "abort",     "crash",      "time-out"};

// |answer - arbiter| by decades: below 1e-8 m, ..., at or above 1e-2 m. Angles: below 1e-6 rad, ..., at or above 1 rad.
inline constexpr int kErrorDecades = 8;
inline constexpr int kAngleDecades = 8;

struct AgreementBin {
  std::array<std::uint64_t, kAgreements.size()> count{};
  std::array<std::uint64_t, kErrorDecades> error{};
  std::array<std::uint64_t, kAngleDecades> angle{};
  std::vector<float> seconds;  // of queries that were answered

  [[nodiscard]] std::uint64_t pairs() const;
  [[nodiscard]] double median_s() const;  // NaN when none was answered
};

struct AgreementTable {
  std::array<AgreementBin, std::size(kSeparations)> by_separation;
  std::array<AgreementBin, std::size(kDegeneracies)> by_degeneracy;
};

Agreement judge(const PairSource& source, const TestPair& pair, const PairAnswer& answer);

// `verdicts` gets one verdict for each pair.
AgreementTable tabulate(const PairSource& source, const std::vector<TestPair>& pairs,
                        const std::vector<PairAnswer>& answers, std::vector<Agreement>& verdicts);

// Which known defects of its library an engine met, from these verdicts.
std::vector<core::DefectHits> defects_met(std::string_view engine_label, PairKind kind,
                                          const std::vector<Agreement>& verdicts);

// "19876 agree, 3 abort; median 1.2 us": only the counts that are not zero.
std::string agreement_text(const AgreementBin& bin);

}  // namespace broadside::bench
