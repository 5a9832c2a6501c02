// The sum modulo 2^64 of one term per record, on all threads of the arena that calls it. The order in which threads add
// does not matter.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace broadside::reference {

template <typename Term>
std::uint64_t parallel_sum(std::size_t count, const Term& term) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count, 1024), std::uint64_t{0},
      [&term](const tbb::blocked_range<std::size_t>& range, std::uint64_t sum) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) sum += term(k);
        return sum;
      },
      std::plus<>());
}

}  // namespace broadside::reference
