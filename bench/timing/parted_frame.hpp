// Finds the pairs of a frame of boxes in parts of space, one part after another with one engine: for a set that does
// not fit at once, or to see what cutting costs before it runs on several devices.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/space_parts.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// What a frame took and found. Pairs are handed on part by part, and no more than one part's are in memory.
struct PartedFrame {
  std::uint64_t dealt = 0;  // boxes of all parts: a box that reaches over a face counts in each
  std::uint64_t largest = 0;
  std::uint64_t pairs = 0;
  std::uint64_t raw = 0;
  std::uint64_t most_pairs_at_once = 0;
  double cut_s = 0.0;  // choosing the cut, and copying each part's boxes
  double load_s = 0.0;
  double find_s = 0.0;
  double filter_s = 0.0;     // part of read_back_s: the engine's own filter
  double read_back_s = 0.0;  // includes leaving out the pairs that other parts find
};

using PairConsumer = std::function<void(std::span<const core::Pair>)>;

core::Result<PartedFrame> find_in_parts(core::BroadPhase& broad, std::span<const core::Box> boxes,
                                        std::span<const std::uint8_t> is_static, std::uint32_t parts,
                                        const PairConsumer& take);

}  // namespace broadside::bench
