// Colors patches so that those of one color share no moved body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::reference {

// In the order of core::color_priority each patch takes the lowest color that no earlier patch of its moved bodies has.
// The result is a function of the list of patches; a patch waits only for its earlier neighbors (Jones and Plassmann,
// 1993).
class PatchColoring {
 public:
  // Patches that share only a face or a body of inverse mass 0 may have the same color.
  void color(std::span<const core::ContactPatch> patches, std::span<const core::RigidMass> masses);

  // Indices of patches by color, by index within a color.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  // Patches of color c are order()[color_begin()[c] .. color_begin()[c + 1]).
  [[nodiscard]] std::span<const std::uint32_t> color_begin() const { return begin_; }
  [[nodiscard]] std::uint32_t color_count() const { return static_cast<std::uint32_t>(begin_.size()) - 1; }

 private:
  struct Ranked {
    std::uint64_t priority;
    std::uint32_t patch;
  };
  std::vector<Ranked> by_priority_;
  std::vector<std::uint32_t> color_;
  std::vector<std::uint32_t> begin_{0};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint64_t> used_;  // per body: bit c, of color c below 64
  std::vector<std::uint32_t> next_;  // per body: the least color from 64 on that is free
};

}  // namespace broadside::reference
