// A sum modulo 2^64 over many records, on all threads of the arena that calls it. The order in which threads add does
// not matter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace broadside::reference {

// sum_of(first, last): the sum over the records first .. last - 1. Called from several threads at once.
std::uint64_t parallel_sum(std::size_t count, const std::function<std::uint64_t(std::size_t, std::size_t)>& sum_of);

// The same with a term for each record.
template <typename Term>
std::uint64_t parallel_sum_of(std::size_t count, const Term& term) {
  return parallel_sum(count, [&term](std::size_t first, std::size_t last) {
    std::uint64_t sum = 0;
    for (std::size_t k = first; k != last; ++k) sum += term(k);
    return sum;
  });
}

}  // namespace broadside::reference
