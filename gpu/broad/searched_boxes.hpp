// The boxes of one search, packed on the host, and the facts on which the sizes of its cells depend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/box_passes.hpp"
#include "core/result.hpp"
#include "gpu/broad/pair_finder_options.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// The error for a box that is not finite or has min > max.
core::Error bad_box(std::size_t place);
// The error for an update with more or fewer boxes than were loaded.
core::Error another_count(std::size_t given, std::size_t loaded);

bool is_sound(const core::Box& box);

// What is known of boxes once all were added.
class FactsOfBoxes {
 public:
  void add(const core::Box& box);
  [[nodiscard]] BoxFacts all() const;

 private:
  BoxFacts facts_;
  core::Box bounds_ = core::empty_box();
};

class SearchedBoxes {
 public:
  // All boxes as they are. An error names the first one that is not a box.
  core::Status take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                    const PairFinderOptions& options);
  // Takes the boxes of a pass, in its coordinates. They must be sound.
  void take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::PassPlan& plan,
            const core::BoxPass& pass);

  void fit(const BulkFit& fit) { facts_.fit = fit; }

  [[nodiscard]] const BoxFacts& facts() const { return facts_; }
  [[nodiscard]] std::span<const PackedBox> searched() const { return searched_; }
  // Some of the searched boxes, from which cells and lanes are fitted.
  [[nodiscard]] std::vector<core::Box> sample() const;
  // Empty if boxes are searched as they are; else the boxes as SettleView has them.
  [[nodiscard]] std::span<const PackedBox> given() const { return given_; }
  [[nodiscard]] std::uint32_t owned() const { return owned_; }

 private:
  void start();
  void add(const core::Box& box, bool is_static);

  std::vector<PackedBox> searched_;
  std::vector<PackedBox> given_;
  FactsOfBoxes facts_of_all_;
  BoxFacts facts_;
  std::uint32_t owned_ = 0;
};

}  // namespace broadside::gpu
