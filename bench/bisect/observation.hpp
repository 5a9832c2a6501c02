// What the command left in the folder of one build, and how two builds differ in it.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/bisect/quantity.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench::bisect {

// The folder holds cells.json, verdicts.json and the traces that the cells name, where the command left any.
struct Observation {
  std::filesystem::path folder;
  int exit_code = 0;
  core::RunRows rows;

  [[nodiscard]] bool has_rows() const { return !rows.cells.empty() || !rows.verdicts.empty(); }
};

core::Result<Observation> read_observation(const std::filesystem::path& folder, int exit_code);

// Everything in which the second differs from the first in this quantity; not for kTime. Rows are matched by scene and
// label of the engine, as 'compare' matches them. What only one build records is no difference, except that kVerdict
// counts a cell that came or went.
core::Result<std::vector<Difference>> differences(const Observation& was, const Observation& is, Quantity quantity);

// Where the traces of both first differ, bit by bit, in the words of 'diff'; empty where no cell has a trace on both
// sides.
std::string traces_apart(const Observation& was, const Observation& is);

}  // namespace broadside::bench::bisect
