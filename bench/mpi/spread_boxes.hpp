// A set of boxes that is spread over the processes of MPI. Each process begins with a slice of the set, is sent the
// boxes that reach into its range of space, and finds the pairs that belong to that range
// (core/engine/space_parts.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/space_parts.hpp"
#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// The slice of the set that a process begins with.
struct BoxSlice {
  std::span<const core::Box> boxes;
  std::span<const std::uint8_t> is_static;
  std::uint32_t first = 0;  // the number of its first box in the set
};

// Computes the same cut in every process. Collective: all processes call it.
core::SpaceCut cut_over_processes(const BoxSlice& slice);

// The boxes of this process's part, in the order of the set. Collective. `sent`: bytes that went to other processes.
core::Result<core::BoxPart> exchange_boxes(const BoxSlice& slice, const core::SpaceCut& cut, std::uint64_t& sent);

// The pairs that belong to this process's part, with box numbers of the whole set. Not collective.
core::Result<std::vector<core::Pair>> find_own_pairs(core::BroadPhase& broad, const core::BoxPart& part,
                                                     const core::SpaceCut& cut, std::uint32_t number);

}  // namespace broadside::bench
