// The search of a bisection: which of several builds in a row is the first that changed?
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::bisect {

// How a build compares with the first one. kUnknown: it cannot be decided, because the build does not compile or its
// run gives no result.
enum class Look { kUnchanged, kChanged, kUnknown };

struct FirstChanged {
  std::size_t last_unchanged = 0;
  std::size_t first_changed = 0;
  std::vector<std::size_t> unknown;  // builds between these two: each may be the first that changed as well
};

// Searches builds 0 .. count-1, of which 0 is unchanged and count-1 is changed. Asks about others, each at most once,
// until every build between the last unchanged and the first changed one is unknown. Of n builds it asks about log2(n).
// Around unknown builds it tries places at ever finer fractions of the interval, because builds that do not compile lie
// side by side. A change that comes and goes is found at one of the places where it comes.
core::Result<FirstChanged> find_first_changed(std::size_t count,
                                              const std::function<core::Result<Look>(std::size_t)>& look);

}  // namespace broadside::bench::bisect
