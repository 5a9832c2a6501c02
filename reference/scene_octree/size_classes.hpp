// Which sizes of boxes share a tree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/size_tree.hpp"

namespace broadside::reference {

struct SizeClasses {
  std::array<std::uint8_t, core::kSizeBins> class_of_bin{};
  // Boxes in each class, finest first.
  std::vector<std::uint32_t> counts;
};

// Starts from one class per occupied bin and merges neighbors while the expected number of pack tests falls: see
// size_classes.cpp for the model. bounds_m3: volume of the bounds of all boxes.
SizeClasses plan_size_classes(const std::array<std::uint32_t, core::kSizeBins>& histogram, double bounds_m3);

}  // namespace broadside::reference
