// One part of a set that is spread over devices: the boxes that begin in it, guests that reach into it, and its search.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/space_parts.hpp"
#include "gpu/broad/border_view.hpp"
#include "gpu/broad/box_search.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {

// Calls in their order: load, then for each search start_borders, finish_borders, make_room_for_guests, a copy of each
// other part's guests, start_search, finish_search. Those that start return at once.
class PartSearch {
 public:
  PartSearch(int device, std::uint32_t part) : device_(device), part_(part) {}

  core::Status load(std::span<const PackedBox> boxes, const BoxFacts& facts, std::uint32_t base,
                    const core::SpaceCut& cut);

  core::Status start_borders();
  // Waits. False: there was too little room, now there is enough, and borders are to be started again.
  core::Result<bool> finish_borders();
  // Boxes of this part that reach into a later one.
  [[nodiscard]] std::uint64_t reaching(std::uint32_t part) const { return reached_[part]; }

  // For so many, of all parts together.
  core::Status make_room_for_guests(std::uint64_t count);
  // Behind those that were copied before.
  core::Status start_copy_from(const PartSearch& other);
  core::Status start_search();
  // Waits. False: pairs were lost; now there is room for them, and the search is to be started again.
  core::Result<bool> finish_search();

  [[nodiscard]] FoundPairs found() const { return has_searched_ ? search_.found() : FoundPairs{}; }
  core::Status append_pairs(std::vector<core::Pair>& to) const;
  core::Result<std::uint64_t> digest();
  [[nodiscard]] std::uint64_t guests() const { return guests_; }
  [[nodiscard]] std::uint64_t bytes() const { return search_.bytes() + out_.bytes(); }
  [[nodiscard]] bool has_searched() const { return has_searched_; }
  [[nodiscard]] const Outcome& outcome() const { return search_.outcome(); }

 private:
  int device_;
  std::uint32_t part_;
  Stream stream_;
  BoxSearch search_;
  BoxFacts facts_;
  PairFinderOptions options_;
  std::uint32_t own_ = 0;
  std::uint64_t guests_ = 0;
  std::uint64_t copied_ = 0;
  bool has_searched_ = false;
  BorderView borders_;
  DeviceBuffer<float> faces_;
  DeviceBuffer<PackedBox> out_;
  DeviceBuffer<unsigned long long> counts_;  // [parts], and the digest behind
  std::vector<unsigned long long> reached_;
};

}  // namespace broadside::gpu
