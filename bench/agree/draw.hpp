// Draws many pairs with the arbiter's answers, in several processes: each pair follows from its index alone.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/agree/pairs.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// Calls draw_one(k) for k from 0 to count - 1 in forked processes; it must write to memory that they share. Must be
// called before this process has started a thread. progress is called with the number of pairs done.
core::Status draw_in_children(std::uint64_t count, std::uint32_t processes,
                              const std::function<void(std::uint64_t)>& draw_one,
                              const std::function<void(std::uint64_t)>& progress);

// Draws pairs 0 to count - 1. Must be called before this process has started a thread. progress is called with the
// number of pairs done.
core::Result<std::vector<TestPair>> draw_pairs(PairSource& source, std::uint64_t count, std::uint32_t processes,
                                               const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
