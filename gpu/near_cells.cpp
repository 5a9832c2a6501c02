#include "gpu/near_cells.hpp"

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
// (13 300 with two trees); cells are 22, 166, 478 and 1309 thousand.
constexpr float kCellsPerTheta = 2.0F;
constexpr std::size_t kMostCells = 1U << 19U;
constexpr std::size_t kMostCellsOfAll = 1U << 26U;
// Above it more vertices lie in the overlap of two boxes than a descent of two trees looks at.
constexpr std::size_t kMostVertices = 1U << 13U;
constexpr std::uint32_t kLeastTop = 2;
// Lists get long where theta is many edges.
constexpr float kMostEdgesInTheta = 4.0F;

// Distances in double: their own rounding is far below what is allowed for.
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

// The grid of one shape, and how far roundings reach.
struct Grid {
  NearCells header;
  double side_m = 0.0;
  double theta_m = 0.0;
  // Of the rounded distance of two vertices, from the exact one: each of the six world coordinates is off by up to half
  // a unit in the last place, 2^-24 of range_m, which makes 2 sqrt(3) 2^-24 range_m = 2.1e-7 range_m; the rest is
  // relative, a few 2^-24 of a distance up to theta.
  double distance_error_m = 0.0;
  // Of the place at which a cell is looked up. 2^-24 of some coordinates of bodies, and of the number of cells in a row
  // (below 1000).
  double place_error_m = 0.0;

  [[nodiscard]] std::size_t cells() const { return std::size_t{header.count_x} * header.count_y * header.count_z; }
  [[nodiscard]] std::array<std::uint32_t, 3> counts() const { return {header.count_x, header.count_y, header.count_z}; }

  // Calls visit(cell's index, cell, place in `vertices`) for every cell that a vertex is nearer to than theta, and some
  // more.
  template <typename Visit>
  void each_cell_near(std::span<const PackedVec3> vertices, const Visit& visit) const {
    const double reach = theta_m + 2.0 * distance_error_m + place_error_m;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Vec3 p = vertices[v].v;
      if (!std::isfinite(p.x)) continue;  // it fills up the last leaf
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
            visit((std::size_t{z} * header.count_y + y) * header.count_x + x, cell_at({x, y, z}), v);
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

Grid grid_around(const Box& box, const NearNeeds& needs) {
  Grid grid;
  grid.theta_m = needs.theta_m;
  grid.side_m = grid.theta_m / kCellsPerTheta;
  grid.distance_error_m = 3e-7 * needs.range_m + 1e-6 * needs.theta_m;
  grid.place_error_m = 1e-3 * grid.side_m + 1e-6 * needs.extent_m;
  grid.header.cells_per_m = static_cast<float>(1.0 / grid.side_m);
  grid.header.range_m = needs.range_m;
  // Rounded down, so that all steps together are no more than theta.
  grid.header.lower_step_m = std::nextafter(static_cast<float>(grid.theta_m / 254.0), 0.0F);
  // One cell more on every side, so that those at the rim are empty.
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
  return grid;
}

bool are_worth_it(const TreeHeader& tree, const NearNeeds& needs) {
  return tree.top >= kLeastTop && tree.node_count[0] * kLeafVertices <= kMostVertices && needs.theta_m > 0.0F &&
         needs.theta_m <= kMostEdgesInTheta * tree.mean_edge_m;
}

}  // namespace

void append_no_cells(ShapeCells& cells) {
  cells.headers.emplace_back();
}

void append_cells(ShapeCells& cells, const ShapeTrees& trees, const NearNeeds& needs) {
  const TreeHeader& tree = trees.headers.back();
  if (!are_worth_it(tree, needs)) return append_no_cells(cells);
  Grid grid = grid_around(unpack(trees.nodes[tree.node_begin[tree.top]]), needs);
  const auto counts = grid.counts();
  // A row of a thousand cells is what place_error_m allows for.
  if (grid.cells() > kMostCells || std::ranges::max(counts) > 1000 ||
      cells.lower.size() + grid.cells() > kMostCellsOfAll)
    return append_no_cells(cells);
  const std::span vertices =
      std::span(trees.vertices).subspan(tree.vertex_begin, std::size_t{tree.node_count[0]} * kLeafVertices);

  // Within this of some vertex wherever in the cell one is.
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
  header.first_lower = static_cast<std::uint32_t>(cells.lower.size());
  header.first_begin = static_cast<std::uint32_t>(cells.begin.size());
  header.first_entry = static_cast<std::uint32_t>(cells.entries.size());
  std::uint32_t total = 0;
  for (std::size_t k = 0; k < grid.cells(); ++k) {
    const double lower = std::max(0.0, nearest[k] - grid.distance_error_m) / header.lower_step_m;
    cells.lower.push_back(length[k] == 0 ? kNothingNear
                                         : static_cast<std::uint8_t>(std::min(std::floor(lower), 254.0)));
    cells.begin.push_back(total);
    total += (length[k] + 1) / 2;
  }
  cells.begin.push_back(total);
  cells.entries.resize(std::size_t{header.first_entry} + total);
  std::vector<std::uint32_t> filled(grid.cells(), 0);
  each_entry([&](std::size_t k, std::size_t v, double) {
    const std::uint32_t place = filled[k]++;
    std::uint32_t& word = cells.entries[header.first_entry + cells.begin[header.first_begin + k] + place / 2];
    const auto vertex = static_cast<std::uint32_t>(v);
    word = place % 2 == 0 ? vertex | vertex << 16U : (word & 0xFFFFU) | vertex << 16U;
  });
  cells.headers.push_back(header);
}

}  // namespace broadside::gpu
