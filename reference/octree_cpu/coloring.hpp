// Colors contacts so that contacts of one color share no written body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pair.hpp"

namespace broadside::reference {

// Applying contacts color by color has the effect of the order of core::color_priority: a contact's color is one more
// than the largest color of the earlier contacts that share a written body with it. The coloring is one fixed function
// of the set of pairs.
class Coloring {
 public:
  // pairs: sorted. Bodies with never_written != 0 conflict with nothing. Afterwards order() lists their indices by
  // color, by pair within a color.
  void color(std::span<const core::Pair> pairs, std::span<const std::uint8_t> never_written);

  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  // Contacts of color c are order()[color_begin()[c] .. color_begin()[c + 1]).
  [[nodiscard]] std::span<const std::uint32_t> color_begin() const { return begin_; }
  [[nodiscard]] std::uint32_t color_count() const { return static_cast<std::uint32_t>(begin_.size()) - 1; }

 private:
  std::vector<std::uint32_t> by_priority_;
  std::vector<std::uint32_t> color_;
  std::vector<std::uint32_t> begin_{0};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> next_;  // per body: the least color of its next contact
};

}  // namespace broadside::reference
