// Pairs of a set of boxes that is spread over devices: each has the boxes that begin in its range of space, is sent
// those of earlier parts that reach into it, and finds the pairs that belong to it (core/engine/space_parts.hpp).
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
  std::uint32_t parts = 0;          // 0: one for each device
  std::uint32_t devices = 0;        // 0: all that there are; with more parts than devices, each has some of them
  std::uint64_t pairs_at_once = 0;  // room for pairs of each part, which are then found in chunks; 0: for all
  std::uint32_t least_for_passes = core::kLeastBoxesForPasses;
};

// Of the last find(), by the host's clock.
struct SpreadTime {
  double borders_s = 0.0;   // which boxes reach into which part
  double exchange_s = 0.0;  // copies of them
  double search_s = 0.0;
  [[nodiscard]] double whole_s() const { return borders_s + exchange_s + search_s; }
};

// update() deals the boxes anew and copies them; find() lets devices exchange borders and search, and leaves the pairs
// on the devices; read_back() gathers and sorts them. Sets that need passes (core/method/box_passes.hpp) are dealt pass
// by pass, each in its own coordinates.
class SpreadFinder final : public core::BroadPhase, public core::HandsPairsOn, public core::TellsPath {
 public:
  explicit SpreadFinder(const SpreadOptions& options);
  ~SpreadFinder() override;

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }
  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update(std::span<const core::Box> boxes) override;
  core::Status find() override;
  // With pairs_at_once: find() counts, and read_back() searches again and gathers all in the host's memory.
  core::Result<core::PairSet> read_back() override;
  // Part after part, in chunks that have room for pairs_at_once, or for as many as find() would first have.
  core::Status hand_on(const Consumer& take) override;
  // Bytes that were copied between parts, those that borders need (a box and its number), and bytes of device memory.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  [[nodiscard]] std::string path() const override;

  // By this cut, not by one of its own.
  core::Status load_cut(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                        const core::SpaceCut& cut);

  [[nodiscard]] SpreadTime time() const;
  // Steps of the part whose search took longest, by its GPU's clock.
  [[nodiscard]] FindTime slowest_steps() const;
  [[nodiscard]] std::uint64_t pair_count() const;
  [[nodiscard]] const core::PassPlan& plan() const;
  // Of the pairs by the numbers that boxes have part by part, in the order of the caller's: the caller's own where its
  // boxes come part by part, and where there are passes. Not with pairs_at_once: then no pairs stay.
  core::Result<std::uint64_t> digest();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu
