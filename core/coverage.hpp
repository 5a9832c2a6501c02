// How many of the laws had something to judge in a trace: a verdict of "pass" says little where most laws had nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "core/verdict.hpp"

namespace broadside::core {

constexpr std::array kLawKinds{LawKind::kMechanics, LawKind::kMethod, LawKind::kTrace};

// Laws of one kind. A law counts as applied when it passed, failed or was inconclusive: it had something to judge.
struct LawCount {
  std::uint64_t applied = 0;
  std::uint64_t laws = 0;
};

struct Coverage {
  std::array<LawCount, kLawKinds.size()> counts;  // in the order of kLawKinds

  [[nodiscard]] const LawCount& of(LawKind kind) const;
  [[nodiscard]] std::uint64_t applied() const;
  [[nodiscard]] std::uint64_t laws() const;
};

// A law that was judged several times, against several baselines, counts once.
Coverage coverage_of(std::span<const Verdict> verdicts);
Coverage coverage_of(std::span<const Verdict* const> verdicts);

// "9 of 14 laws of mechanics applied, 5 of 7 of the trace"; kinds without a requested law are left out.
std::string coverage_text(const Coverage& coverage);

}  // namespace broadside::core
