// Surfaces that move for one step, from formulas: what candidates of continuous collision are found on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/continuous/moving_surface.hpp"
#include "core/result.hpp"

namespace broadside::datasets {

// A square sheet, folded like an accordion into eight layers of about `triangles` in all (16 at least). At the start
// the layers are planes and meet at the creases alone. In the step they bulge by turns up and down, past each other
// near the creases; and the sheet moves sideways by half a cell.
continuous::MovingSurface folding_sheet(std::uint64_t triangles, std::uint64_t seed);

// Lumpy bodies of 320 triangles and up to 1 m, about `triangles` in all (640 at least), free of each other on a lattice
// at the start. In the step each eight of them press together by a third of the way to their middle, and each body
// turns and strays by up to 0.1 m besides. The vertices move along straight lines between the two placements.
continuous::MovingSurface moving_heap(std::uint64_t triangles, std::uint64_t seed);

struct MotionRow {
  std::string_view pattern;  // "folding-sheet:N"
  std::string_view example;
  std::string_view what;
};
std::vector<MotionRow> motion_table();

// Errors: an unknown name, with the nearest; N outside of 1 to 20,000,000.
core::Result<continuous::MovingSurface> make_motion(const std::string& spec, std::optional<std::uint64_t> seed = {});

}  // namespace broadside::datasets
