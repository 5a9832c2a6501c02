#include "gpu/scene/near_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/math/box.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Vec3;

// In a heap of bunnies a search takes 4100, 2500, 2200 and 2000 instructions with cells of 1, 1/2, 1/3 and 1/4 theta
// (13 300 with two trees); there are 22, 166, 478 and 1309 thousand cells then.
constexpr double kCellsPerTheta = 2.0;
constexpr std::size_t kMostCellsOfShape = 1U << 19U;
constexpr std::size_t kMostCellsOfAll = 1U << 26U;
// In shapes with more vertices, more of them lie in the overlap of two boxes than a descent of two trees looks at.
constexpr std::size_t kMostVertices = 1U << 13U;
constexpr std::uint32_t kLeastTop = 2;
// Lists get long if theta is many times the length of an edge.
constexpr float kMostEdgesInTheta = 4.0F;

// Distances are computed in double, whose rounding is far below what the grid allows for.
struct Range {
  double low;
  double high;
};
using Cell = std::array<Range, 3>;

double nearest_m(const Cell& cell, Vec3 p) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({0.0, cell[k].low - p[k], p[k] - cell[k].high});
    sum += d * d;
  }
  return std::sqrt(sum);
}

double farthest_m(const Cell& cell, Vec3 p) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max(std::abs(cell[k].low - p[k]), std::abs(cell[k].high - p[k]));
    sum += d * d;
  }
  return std::sqrt(sum);
}

// The grid of one shape, and how much rounding can change.
struct Grid {
  NearCells header;
  double side_m = 0.0;
  double theta_m = 0.0;
  // How far the rounded distance of two vertices may be from the exact one. Each of the six world coordinates is off by
  // up to half a unit in the last place, 2^-24 of range_m, which makes 2 sqrt(3) 2^-24 range_m = 2.1e-7 range_m. The
  // rest is relative: a few 2^-24 of a distance up to theta.
  double distance_error_m = 0.0;
  // How far the place at which a cell is looked up may be off: up to one quantum, and 2^-24 of some coordinates of
  // bodies.
  double place_error_m = 0.0;

  // The number of cells, with those that fill up the last bricks.
  [[nodiscard]] std::size_t cells() const {
    return (std::size_t{header.stride_z} + 128) * ((std::size_t{header.count_z} + 3) / 4);
  }
  [[nodiscard]] std::array<std::uint32_t, 3> counts() const { return {header.count_x, header.count_y, header.count_z}; }

  // For each vertex, calls visit(cell's index, cell, place in `vertices`) for every cell nearer to it than theta, and
  // for some more.
  template <typename Visit>
  void each_cell_near(std::span<const PackedVec3> vertices, const Visit& visit) const {
    const double reach = theta_m + 2.0 * distance_error_m + place_error_m;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Vec3 p = vertices[v].v;
      if (!std::isfinite(p.x)) continue;  // only fills up the last leaf
      std::array<std::uint32_t, 3> first{};
      std::array<std::uint32_t, 3> last{};
      for (int k = 0; k < 3; ++k) {
        const double at = (static_cast<double>(p[k]) - header.low[k]) / side_m;
        const double most = counts()[k] - 1.0;
        first[k] = static_cast<std::uint32_t>(std::clamp(std::floor(at - reach / side_m), 0.0, most));
        last[k] = static_cast<std::uint32_t>(std::clamp(std::floor(at + reach / side_m), 0.0, most));
      }
      for (std::uint32_t z = first[2]; z <= last[2]; ++z)
        for (std::uint32_t y = first[1]; y <= last[1]; ++y)
          for (std::uint32_t x = first[0]; x <= last[0]; ++x)
            visit(cell_index(x, y, z, header.stride_y, header.stride_z), cell_at({x, y, z}), v);
    }
  }

  [[nodiscard]] Cell cell_at(std::array<std::uint32_t, 3> at) const {
    Cell cell{};
    for (int k = 0; k < 3; ++k) {
      const double low = header.low[k] + side_m * at[k];
      cell[k] = {low - place_error_m, low + side_m + place_error_m};
    }
    return cell;
  }
};

// How many quanta the finest cell has, as a power of two: as many as possible while the sum of a vertex's and an
// origin's quanta stays within 2^15.
std::uint32_t quanta_bits(const NearNeeds& needs) {
  std::uint32_t bits = 7;
  // Cells, with a body on either side of them, reach over some six extents.
  while (bits > 4 && 6.0 * needs.extent_m / needs.least_theta_m * kCellsPerTheta * (1U << bits) > 30000.0) --bits;
  return bits;
}

Grid grid_around(const Box& box, const NearNeeds& needs) {
  Grid grid;
  grid.theta_m = needs.theta_m;
  grid.header.shift = quanta_bits(needs);
  grid.header.quanta_per_m = static_cast<float>((1U << grid.header.shift) * kCellsPerTheta / needs.least_theta_m);
  const double quantum_m = 1.0 / static_cast<double>(grid.header.quanta_per_m);
  while (quantum_m * (2U << grid.header.shift) <= grid.theta_m / kCellsPerTheta) ++grid.header.shift;
  grid.side_m = quantum_m * (1U << grid.header.shift);
  grid.header.reach = static_cast<std::int32_t>(std::min(needs.extent_m / quantum_m, 1e6)) + 2;
  grid.distance_error_m = 3e-7 * needs.range_m + 1e-6 * needs.theta_m;
  grid.place_error_m = 1.05 * quantum_m + 1e-6 * needs.extent_m;
  grid.header.range_m = needs.range_m;
  // Rounded down, so that all steps together are no more than theta.
  grid.header.lower_step_m = std::nextafter(static_cast<float>(grid.theta_m / 254.0), 0.0F);
  // One more cell on every side, so that cells at the rim are empty.
  const double margin = grid.side_m + grid.theta_m + 2.0 * (grid.distance_error_m + grid.place_error_m);
  std::array<std::uint32_t, 3> count{};
  std::array<float, 3> low{};
  for (int k = 0; k < 3; ++k) {
    low[k] = static_cast<float>(box.min[k] - margin);
    const double cells = std::floor((box.max[k] + margin - low[k]) / grid.side_m) + 1.0;
    count[k] = static_cast<std::uint32_t>(std::min(cells, 1e6));
  }
  grid.header.low = {low[0], low[1], low[2]};
  grid.header.count_x = count[0];
  grid.header.count_y = count[1];
  grid.header.count_z = count[2];
  const std::uint32_t row = (count[0] + 7) / 8 * 128;
  grid.header.stride_y = row - 32;
  grid.header.stride_z = row * ((count[1] + 3) / 4) - 128;
  return grid;
}

// Whether the sum of a vertex's and an origin's quanta is below 2^15 wherever the bodies are: see
// stages/vertices/cell_search.cuh.
bool are_quanta_few(const Grid& grid) {
  const std::uint64_t cells = std::ranges::max(grid.counts());
  return (cells << grid.header.shift) + 2 * static_cast<std::uint64_t>(grid.header.reach) < (1U << 15U) - 2;
}

bool are_worth_it(const TreeHeader& tree, const NearNeeds& needs) {
  return tree.top >= kLeastTop && std::uint64_t{tree.node_count[0]} * kLeafVertices <= kMostVertices &&
         needs.theta_m > 0.0F && needs.theta_m <= kMostEdgesInTheta * tree.mean_edge_m;
}

}  // namespace

void append_no_cells(ShapeCells& cells) {
  cells.headers.emplace_back();
}

void append_cells(ShapeCells& cells, const ShapeTrees& trees, const NearNeeds& needs) {
  const TreeHeader& tree = trees.headers.back();
  if (!are_worth_it(tree, needs)) return append_no_cells(cells);
  Grid grid = grid_around(unpack(trees.nodes[tree.node_begin[tree.top]]), needs);
  if (grid.cells() > kMostCellsOfShape || !are_quanta_few(grid) || cells.lower.size() + grid.cells() > kMostCellsOfAll)
    return append_no_cells(cells);
  const std::span vertices =
      std::span(trees.vertices).subspan(tree.vertex_begin, std::size_t{tree.node_count[0]} * kLeafVertices);

  // For each cell, a distance within which every point of it has a vertex.
  std::vector<double> within(grid.cells(), grid.theta_m);
  grid.each_cell_near(vertices, [&](std::size_t k, const Cell& cell, std::size_t v) {
    within[k] = std::min(within[k], farthest_m(cell, vertices[v].v));
  });
  std::vector<double> nearest(grid.cells(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> length(grid.cells(), 0);
  const auto each_entry = [&](const auto& visit) {
    grid.each_cell_near(vertices, [&](std::size_t k, const Cell& cell, std::size_t v) {
      const double d = nearest_m(cell, vertices[v].v);
      if (d <= within[k] + 2.0 * grid.distance_error_m) visit(k, v, d);
    });
  };
  each_entry([&](std::size_t k, std::size_t, double d) {
    nearest[k] = std::min(nearest[k], d);
    ++length[k];
  });

  NearCells& header = grid.header;
  std::vector<std::uint32_t> begin(grid.cells(), 0);
  std::uint64_t total = 0;
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    begin[k] = static_cast<std::uint32_t>(total);
    total += (length[k] + 3) / 4;
  }
  constexpr std::uint32_t kMostLength = (1U << NearList::kLengthBits) - 1;
  constexpr std::uint64_t kMostEntries = 1ULL << (32U - NearList::kLengthBits);
  if (total >= kMostEntries || std::ranges::max(length) / 4 >= kMostLength) return append_no_cells(cells);
  header.first_lower = static_cast<std::uint32_t>(cells.lower.size());
  header.first_list = static_cast<std::uint32_t>(cells.lists.size());
  header.first_entry = static_cast<std::uint32_t>(cells.entries.size());
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    const double lower = std::max(0.0, nearest[k] - grid.distance_error_m) / header.lower_step_m;
    cells.lower.push_back(length[k] == 0 ? kNothingNear
                                         : static_cast<std::uint8_t>(std::min(std::floor(lower), 254.0)));
    cells.lists.push_back(begin[k] << NearList::kLengthBits | (length[k] + 3) / 4);
  }
  cells.entries.resize(header.first_entry + total);
  std::vector<std::uint32_t> filled(grid.cells(), 0);
  each_entry([&](std::size_t k, std::size_t v, double) {
    const std::uint32_t place = filled[k]++;
    NearEntry& entry = cells.entries[header.first_entry + begin[k] + place / 4];
    // Also fills the rest of the entry, until other vertices overwrite it.
    for (std::uint32_t rest = place % 4; rest < 4; ++rest) entry.vertex[rest] = static_cast<std::uint16_t>(v);
  });
  cells.headers.push_back(header);
}

void quantize_vertices(ShapeCells& cells, const ShapeTrees& trees) {
  const auto with_cells = std::ranges::find_if(cells.headers, [](const NearCells& c) { return c.count_x != 0; });
  if (with_cells == cells.headers.end()) return;
  const auto quanta = [&](float v) {
    return static_cast<std::int16_t>(std::floor(static_cast<double>(v) * with_cells->quanta_per_m));
  };
  for (const PackedVec3& vertex : trees.vertices)
    cells.quantized.push_back(std::isfinite(vertex.v.x)
                                  ? QuantizedVertex{quanta(vertex.v.x), quanta(vertex.v.y), quanta(vertex.v.z)}
                                  : cells.quantized.back());
}

}  // namespace broadside::gpu
