#include <array>
#include <charconv>
#include <utility>

#include "core/nearest_name.hpp"
#include "datasets/generators/scene_options.hpp"
#include "datasets/motions/motions.hpp"

namespace broadside::datasets {
namespace {

// A moving vertex and its triangles take 100 bytes: 2 GB in all, and candidates several times as much.
constexpr std::uint64_t kMostTriangles = 20'000'000;

struct MotionSet {
  std::string_view prefix;
  MotionRow row;
  continuous::MovingSurface (*make)(std::uint64_t triangles, std::uint64_t seed);
};

constexpr std::array<MotionSet, 2> kMotions{{
    {"folding-sheet:",
     {"folding-sheet:N", "folding-sheet:100000", "a sheet of N triangles in eight layers that bulge past each other"},
     folding_sheet},
    {"moving-heap:",
     {"moving-heap:N", "moving-heap:100000", "lumpy bodies of 320 triangles, N in all, that move together and turn"},
     moving_heap},
}};

}  // namespace

std::vector<MotionRow> motion_table() {
  std::vector<MotionRow> rows;
  rows.reserve(std::size(kMotions));
  for (const MotionSet& set : kMotions) rows.push_back(set.row);
  return rows;
}

core::Result<continuous::MovingSurface> make_motion(const std::string& spec, std::optional<std::uint64_t> seed) {
  for (const MotionSet& set : kMotions) {
    if (!spec.starts_with(set.prefix)) continue;
    const std::string_view digits = std::string_view(spec).substr(set.prefix.size());
    std::uint64_t n = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (failed != std::errc() || end != digits.data() + digits.size() || n < 1 || n > kMostTriangles)
      return core::Error{"the number of triangles is '" + std::string(digits) + "'", "motion '" + spec + "'",
                         "give a whole number from 1 to " + std::to_string(kMostTriangles)};
    continuous::MovingSurface made = set.make(n, seed.value_or(kDefaultSeed));
    made.name = spec;
    return made;
  }
  std::vector<std::string_view> known;
  known.reserve(std::size(kMotions));
  for (const MotionSet& set : kMotions) known.push_back(set.row.example);
  return core::Error{"no such motion", "motion '" + spec + "'",
                     core::advise_name(spec, known) + "; or give two mesh files, START --to END"};
}

}  // namespace broadside::datasets
