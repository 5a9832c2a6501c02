// Finds the pairs of a set of boxes that is spread over devices. Space is cut into parts. A part has the boxes that
// begin in it, gets those of earlier parts that reach into it, and finds the pairs that belong to it
// (core/engine/space_parts.hpp).
#pragma once

#include <cstdint>
#include <memory>

#include "core/engine/broad_phase.hpp"
#include "core/engine/pair_chunks.hpp"
#include "core/engine/search_path.hpp"
#include "core/engine/space_parts.hpp"
#include "core/method/box_passes.hpp"
#include "gpu/broad/find_time.hpp"

namespace broadside::gpu {

struct SpreadOptions {
  std::uint32_t parts = 0;    // 0: one for each device
  std::uint32_t devices = 0;  // 0: all of the machine; if there are more parts than devices, each device has several
  std::uint64_t pairs_at_once = 0;  // how many a part has room for, so that it finds them in chunks; 0: all
  std::uint32_t least_for_passes = core::kLeastBoxesForPasses;
};

// The time of the last find(), by the host's clock.
struct SpreadTime {
  double borders_s = 0.0;   // finding which boxes reach into which part
  double exchange_s = 0.0;  // copying these boxes
  double search_s = 0.0;
  [[nodiscard]] double whole_s() const { return borders_s + exchange_s + search_s; }
};

// update() deals the boxes to parts anew and copies them; find() lets devices exchange boxes at borders and search, and
// leaves the pairs on the devices; read_back() gathers and sorts them. Sets that need passes
// (core/method/box_passes.hpp) are dealt pass by pass, each in its own coordinates.
class SpreadFinder final : public core::BroadPhase, public core::HandsPairsOn, public core::TellsPath {
 public:
  explicit SpreadFinder(const SpreadOptions& options);
  ~SpreadFinder() override;

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }
  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update(std::span<const core::Box> boxes) override;
  core::Status find() override;
  // With pairs_at_once, find() only counts pairs, and read_back() searches again and gathers all of them in the host's
  // memory.
  core::Result<core::PairSet> read_back() override;
  // Hands pairs on part by part, in chunks of at most pairs_at_once, or of the room with which find() would begin.
  core::Status hand_on(const Consumer& take) override;
  // Counts the bytes that were copied between parts, the bytes that borders need (a box and its number), and bytes of
  // device memory.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  [[nodiscard]] std::string path() const override;

  // Loads boxes with this cut instead of one that it chooses itself.
  core::Status load_cut(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                        const core::SpaceCut& cut);

  [[nodiscard]] SpreadTime time() const;
  // The times of the steps of the part whose search took longest, by its GPU's clock.
  [[nodiscard]] FindTime slowest_steps() const;
  [[nodiscard]] std::uint64_t pair_count() const;
  [[nodiscard]] const core::PassPlan& plan() const;
  // The digest of the pairs. Boxes have the numbers that they get part by part, in the caller's order within a part;
  // these are the caller's own numbers if its boxes come part by part. With passes they always are the caller's. There
  // is no digest with pairs_at_once, since no pairs stay.
  core::Result<std::uint64_t> digest();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu
