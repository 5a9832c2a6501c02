#include "bench/timing/parted_frame.hpp"

#include <algorithm>
#include <chrono>

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

core::Result<PartedFrame> find_in_parts(core::BroadPhase& broad, std::span<const core::Box> boxes,
                                        std::span<const std::uint8_t> is_static, std::uint32_t parts,
                                        const PairConsumer& take) {
  PartedFrame frame;
  const auto start = Clock::now();
  const core::SpaceCut cut = core::cut_space(boxes, parts);
  frame.cut_s = seconds(start, Clock::now());
  for (std::uint32_t part = 0; part < cut.parts(); ++part) {
    const auto begin = Clock::now();
    const core::BoxPart own = core::part_of(cut, part, boxes, is_static);
    const auto dealt = Clock::now();
    frame.cut_s += seconds(begin, dealt);
    frame.dealt += own.boxes.size();
    frame.largest = std::max<std::uint64_t>(frame.largest, own.boxes.size());
    if (own.boxes.size() < 2) continue;
    if (core::Status s = broad.load(own.boxes, own.is_static); !s) return s.error();
    const auto loaded = Clock::now();
    if (core::Status s = broad.find(); !s) return s.error();
    const auto found = Clock::now();
    auto pairs = broad.read_back();
    if (!pairs) return pairs.error();
    core::keep_own_pairs(cut, part, own, pairs.value().pairs);
    frame.load_s += seconds(dealt, loaded);
    frame.find_s += seconds(loaded, found);
    frame.read_back_s += seconds(found, Clock::now());
    frame.filter_s += pairs.value().filter_s;
    frame.raw += pairs.value().raw;
    frame.pairs += pairs.value().pairs.size();
    frame.most_pairs_at_once = std::max<std::uint64_t>(frame.most_pairs_at_once, pairs.value().demanded);
    take(pairs.value().pairs);
  }
  return frame;
}

}  // namespace broadside::bench
