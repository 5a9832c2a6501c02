// The search of a bisection: which of several builds in a row is the first that changed?
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::bisect {

// A build against the first one. kUnknown: it cannot be told, because the build does not compile or its run says
// nothing.
enum class Look { kUnchanged, kChanged, kUnknown };

struct FirstChanged {
  std::size_t last_unchanged = 0;
  std::size_t first_changed = 0;
  std::vector<std::size_t> unknown;  // builds between these two: each may be the first that changed as well
};

// Builds 0 .. count-1, of which 0 is unchanged and count-1 is changed; asks about others, each at most once, until no
// build between the last unchanged and the first changed one can be told. Of n builds it asks about log2(n). Where
// builds are unknown it moves away from them in ever finer steps, because builds that do not compile lie side by side.
// A change that comes and goes is found at one of the places where it comes.
core::Result<FirstChanged> find_first_changed(std::size_t count,
                                              const std::function<core::Result<Look>(std::size_t)>& look);

}  // namespace broadside::bench::bisect
