// How the search of bulk pairs is fitted to its boxes: fitted_cells.hpp chooses these values.
#pragma once

#include <cstdint>

namespace broadside::gpu {

struct BulkFit {
  float cell_scale = 1.0F;  // the largest cells are this many times as large as the largest box: from 1 to below 4
  std::uint32_t levels_apart = 2;   // levels that have boxes are this many apart: 2 or 4
  std::uint32_t x_halvings = 0;     // how often cells are halved along x, the axis of their rows: at most 2
  std::uint32_t lanes_per_box = 1;  // 1 or kLanesOfCrowd
  bool is_grouped = false;          // by groups of neighboring boxes, as long as few of these overlap: grouped_view.hpp
};

}  // namespace broadside::gpu
