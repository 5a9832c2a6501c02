#include "core/coverage.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace broadside::core {

const LawCount& Coverage::of(LawKind kind) const {
  const auto at = std::find(kLawKinds.begin(), kLawKinds.end(), kind) - kLawKinds.begin();
  return counts[static_cast<std::size_t>(at)];
}

std::uint64_t Coverage::applied() const {
  std::uint64_t sum = 0;
  for (const LawCount& count : counts) sum += count.applied;
  return sum;
}

std::uint64_t Coverage::laws() const {
  std::uint64_t sum = 0;
  for (const LawCount& count : counts) sum += count.laws;
  return sum;
}

Coverage coverage_of(std::span<const Verdict> verdicts) {
  std::vector<const Verdict*> pointers;
  for (const Verdict& verdict : verdicts) pointers.push_back(&verdict);
  return coverage_of(pointers);
}

Coverage coverage_of(std::span<const Verdict* const> verdicts) {
  std::map<std::string_view, std::pair<LawKind, bool>> laws;
  for (const Verdict* verdict : verdicts) {
    const auto at = laws.emplace(verdict->validator, std::pair(verdict->kind, false)).first;
    at->second.second |= verdict->outcome != Outcome::kNotApplicable;
  }
  Coverage coverage;
  for (std::size_t k = 0; k < kLawKinds.size(); ++k)
    for (const auto& [name, law] : laws) {
      if (law.first != kLawKinds[k]) continue;
      ++coverage.counts[k].laws;
      if (law.second) ++coverage.counts[k].applied;
    }
  return coverage;
}

std::string coverage_text(const Coverage& coverage) {
  static constexpr std::string_view kOf[] = {"mechanics", "the method", "the trace"};
  static_assert(std::size(kOf) == kLawKinds.size());
  std::string text;
  for (std::size_t k = 0; k < kLawKinds.size(); ++k) {
    const LawCount& count = coverage.counts[k];
    if (count.laws == 0) continue;
    const std::string numbers = std::to_string(count.applied) + " of " + std::to_string(count.laws);
    const std::string of = " of " + std::string(kOf[k]);
    text += text.empty() ? numbers + (count.laws == 1 ? " law" : " laws") + of + " applied" : ", " + numbers + of;
  }
  return text.empty() ? "no law was asked for" : text;
}

}  // namespace broadside::core
