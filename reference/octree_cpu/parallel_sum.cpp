#include "reference/octree_cpu/parallel_sum.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

namespace broadside::reference {
namespace {

// Records per task: hashing this many takes some ten microseconds, about as long as handing them to a thread.
constexpr std::size_t kRecordsPerTask = 1024;

}  // namespace

std::uint64_t parallel_sum(std::size_t count, const std::function<std::uint64_t(std::size_t, std::size_t)>& sum_of) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count, kRecordsPerTask), std::uint64_t{0},
      [&sum_of](const tbb::blocked_range<std::size_t>& r, std::uint64_t sum) {
        return sum + sum_of(r.begin(), r.end());
      },
      std::plus<>());
}

}  // namespace broadside::reference
