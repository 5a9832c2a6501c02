// Surfaces that move for one step, made from formulas: inputs for finding candidates of continuous collision.
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
// the layers are planes and meet only at the creases. During the step they bulge alternately up and down, past each
// other near the creases, and the sheet moves sideways by half a cell.
continuous::MovingSurface folding_sheet(std::uint64_t triangles, std::uint64_t seed);

// Lumpy bodies of 320 triangles and up to 1 m, about `triangles` in all (640 at least), apart from each other on a
// lattice at the start. During the step, every eight neighbors move together by a third of the way to their middle, and
// each body also turns and moves randomly by up to 0.1 m. The vertices move along straight lines between the two
// placements.
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
