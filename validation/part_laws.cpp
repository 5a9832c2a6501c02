#include "validation/part_laws.hpp"

#include <algorithm>

namespace broadside::validation {
namespace {

// "integration 3 of 1200, worst at step 9, body 5".
std::string broken_text(const core::Verdict& part) {
  std::string text = part.validator + " " + std::to_string(part.violations) + " of " + std::to_string(part.checked) +
                     ", worst at step " + std::to_string(part.worst.step);
  for (std::size_t k = 0; k < part.worst.bodies.size(); ++k)
    text += (k == 0 ? ", " : " and ") + body_text(part.worst.bodies[k]);
  return text;
}

}  // namespace

core::Verdict sum_up(std::span<const PartLaw> parts, Tally whole, std::string_view nothing, const std::string& notes) {
  for (const PartLaw& part : parts) whole.absorb(part.tally);
  core::Verdict verdict = whole.conclude(nothing, notes);
  std::string broken;
  for (const PartLaw& part : parts) {
    core::Verdict own = part.tally.conclude(part.nothing);
    own.law = part.law;
    own.ties_motion_to_forces = own.moved > 0;
    if (own.outcome == core::Outcome::kFail) broken += (broken.empty() ? "" : "; ") + broken_text(own);
    verdict.parts.push_back(std::move(own));
  }
  if (!broken.empty()) verdict.explanation += "; by law: " + broken;
  return verdict;
}

}  // namespace broadside::validation
