#include "bench/bisect/first_changed.hpp"

#include <optional>
#include <set>

namespace broadside::bench::bisect {
namespace {

// The fractions 1/2, 1/4, 3/4, 1/8, 5/8 ... of an interval: where to look next after so many unknown builds in it.
double fraction(std::size_t unknown) {
  double result = 0.0;
  double part = 0.5;
  for (std::size_t rest = unknown + 1; rest > 0; rest /= 2, part /= 2)
    if (rest % 2 == 1) result += part;
  return result;
}

// The build between low and high that is nearest to the wanted place and not unknown.
std::optional<std::size_t> nearest(std::size_t low, std::size_t high, double wanted,
                                   const std::set<std::size_t>& unknown) {
  std::optional<std::size_t> best;
  const auto distance = [&](std::size_t k) {
    const double d = static_cast<double>(k) - wanted;
    return d < 0 ? -d : d;
  };
  for (std::size_t k = low + 1; k < high; ++k)
    if (!unknown.contains(k) && (!best || distance(k) < distance(*best))) best = k;
  return best;
}

}  // namespace

core::Result<FirstChanged> find_first_changed(std::size_t count,
                                              const std::function<core::Result<Look>(std::size_t)>& look) {
  std::size_t low = 0;
  std::size_t high = count - 1;
  std::set<std::size_t> unknown;  // of those between low and high
  while (true) {
    std::erase_if(unknown, [&](std::size_t k) { return k < low || k > high; });
    const double wanted = static_cast<double>(low) + fraction(unknown.size()) * static_cast<double>(high - low);
    const auto next = nearest(low, high, wanted, unknown);
    if (!next) return FirstChanged{low, high, {unknown.begin(), unknown.end()}};
    const auto found = look(*next);
    if (!found) return found.error();
    switch (found.value()) {
      case Look::kUnchanged:
        low = *next;
        break;
      case Look::kChanged:
        high = *next;
        break;
      case Look::kUnknown:
        unknown.insert(*next);
        break;
    }
  }
}

}  // namespace broadside::bench::bisect
