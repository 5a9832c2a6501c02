// One part of a set that is spread over devices: the boxes that begin in it, guests that reach into it, and its search.
#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/space_parts.hpp"
#include "gpu/broad/border_view.hpp"
#include "gpu/broad/box_search.hpp"
#include "gpu/broad/dealt_boxes.hpp"
#include "gpu/broad/pair_chunks.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {

struct PartOptions {
  bool is_pass = false;
  std::uint32_t owned = 0;          // of a pass: SettleView
  std::uint64_t pairs_at_once = 0;  // how many there is room for; 0: all
};

// By which numbers pairs name boxes: those that boxes get part by part, or the caller's. Pairs of a pass always have
// the caller's.
enum class Numbers { kDealt, kCallers };

// Calls must come in this order: load; then for each search start_borders, finish_borders, make_room_for_guests,
// start_copy_from for each other part, and then either start_search and finish_search, or hand_on. The calls named
// start_... return at once.
class PartSearch {
 public:
  PartSearch(int device, std::uint32_t part) : device_(device), part_(part) {}

  core::Status load(const DealtBoxes& dealt, const core::SpaceCut& cut, const PartOptions& options);

  core::Status start_borders(Numbers numbers);
  // Waits. Returns false if there was too little room: now there is enough, and start_borders must be called again.
  core::Result<bool> finish_borders();
  // How many boxes of this part reach into this later part.
  [[nodiscard]] std::uint64_t reaching(std::uint32_t part) const { return reached_[part]; }

  // `count`: guests from all other parts together.
  core::Status make_room_for_guests(std::uint64_t count);
  // Appends the guests from that part to those that were copied before.
  core::Status start_copy_from(const PartSearch& other);
  core::Status start_search();
  // Waits. Returns false if pairs were lost: now there is room for them, and start_search must be called again.
  core::Result<bool> finish_search();

  // Hands pairs on in chunks, each of as many pairs as there is room for.
  core::Status hand_on(const ChunkConsumer& take);

  [[nodiscard]] FoundPairs found() const { return has_searched_ ? search_.found() : FoundPairs{}; }
  core::Status append_pairs(std::vector<core::Pair>& to) const;
  core::Result<std::uint64_t> digest();
  [[nodiscard]] std::uint64_t guests() const { return guests_; }
  [[nodiscard]] std::uint64_t bytes() const { return search_.bytes() + out_.bytes() + given_out_.bytes(); }
  [[nodiscard]] bool has_searched() const { return has_searched_; }
  [[nodiscard]] const Outcome& outcome() const { return search_.outcome(); }

 private:
  core::Status reserve_guests(std::uint64_t of_each_part);
  core::Status prepare_search();
  [[nodiscard]] PairNames names() const;

  int device_;
  std::uint32_t part_;
  Stream stream_;
  BoxSearch search_;
  BoxFacts facts_;
  PairFinderOptions options_;
  bool is_pass_ = false;
  std::uint32_t owned_ = 0;
  Numbers numbers_ = Numbers::kDealt;
  std::uint32_t own_ = 0;
  std::uint64_t guests_ = 0;
  std::uint64_t copied_ = 0;
  bool has_searched_ = false;
  BorderView borders_;
  DeviceBuffer<float> faces_;
  DeviceBuffer<PackedBox> out_;
  DeviceBuffer<PackedBox> given_out_;        // in a pass: the same boxes as given
  DeviceBuffer<unsigned long long> counts_;  // [parts], then the digest
  std::vector<unsigned long long> reached_;
};

}  // namespace broadside::gpu
