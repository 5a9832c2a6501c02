// How long one query takes.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace broadside::bench {

inline double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// The lesser of elapsed and processor time: elapsed time also counts interruptions by other programs, processor time
// adds up all threads of a query.
template <typename Query>
float seconds_of(Query&& query) {
  using Clock = std::chrono::steady_clock;
  const double used = processor_seconds();
  const auto start = Clock::now();
  query();
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  return static_cast<float>(std::min(elapsed, processor_seconds() - used));
}

}  // namespace broadside::bench
