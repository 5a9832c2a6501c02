#include "datasets/generators/start_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "datasets/cube_root.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

using core::Box;
using core::Vec3;
using Triple = std::array<double, 3>;

Vec3 rounded_start(const Triple& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

Triple sides_of(const Box& box) {
  Triple sides;
  for (int k = 0; k < 3; ++k) sides[k] = double{box.max[k]} - double{box.min[k]};
  return sides;
}

Triple middle_of(const Box& box) {
  Triple middle;
  for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (double{box.max[k]} + double{box.min[k]});
  return middle;
}

using Cells = std::array<std::uint64_t, 3>;

std::uint64_t product(const Cells& c) {
  return c[0] * c[1] * c[2];
}

// Cells per axis: as few as hold `count`, each larger than the box; cells are removed from the tightest axis first. {}
// when there is no such grid.
Cells cells_for(double width, const Triple& sides, std::uint64_t count) {
  Cells cells{};
  for (int k = 0; k < 3; ++k) {
    // Leaves at least 1 % of the side free, so that the shift within a cell is more than rounding.
    cells[k] = static_cast<std::uint64_t>(std::min(width / (1.01 * sides[k]), 1e6));
    if (cells[k] == 0) return {};
  }
  if (product(cells) < count) return {};
  for (;;) {
    int tightest = -1;
    double least = 0.0;
    for (int k = 0; k < 3; ++k) {
      Cells fewer = cells;
      --fewer[k];
      if (product(fewer) < std::max<std::uint64_t>(count, 1)) continue;
      const double spare = width / static_cast<double>(cells[k]) - sides[k];
      if (tightest < 0 || spare < least) tightest = k, least = spare;
    }
    if (tightest < 0) return cells;
    --cells[tightest];
  }
}

}  // namespace

void place(core::Scene& scene, const Start& start) {
  scene.domain = start.domain;
  scene.bodies.resize(start.positions.size());
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    scene.bodies[n].position = start.positions[n];
    scene.bodies[n].velocity = start.velocities[n];
  }
}

Start stacked_grid(const Box& body, std::uint32_t count, const StackedGrid& grid, std::uint64_t seed) {
  const Triple sides = sides_of(body);
  const Triple middle = middle_of(body);
  const double longest = std::max({sides[0], sides[1], sides[2]});
  const double gap = grid.gap * longest;
  const double pitch = longest + gap;
  std::uint64_t g = 1;
  while (g * g * g < count) ++g;
  const std::uint64_t layers = std::max<std::uint64_t>(1, (count + g * g - 1) / (g * g));

  RandomStream random(seed);
  Start start;
  start.positions.reserve(count);
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::uint64_t layer = n / (g * g);
    const Triple cell{static_cast<double>(n % g) - 0.5 * static_cast<double>(g - 1), static_cast<double>(layer),
                      static_cast<double>(n / g % g) - 0.5 * static_cast<double>(g - 1)};
    Triple p;
    for (int k = 0; k < 3; ++k) p[k] = cell[k] * pitch - middle[k] + random.between(-grid.jitter, grid.jitter) * gap;
    p[1] += grid.drop_m + 0.5 * sides[1];
    start.positions.push_back(rounded_start(p));
  }
  start.velocities.assign(count, Vec3{});

  const double width = grid.width_of_grid * static_cast<double>(g) * pitch;
  const double height = std::max(width, grid.drop_m + static_cast<double>(layers + 1) * pitch);
  start.domain = {rounded_start({-0.5 * width, 0.0, -0.5 * width}), rounded_start({0.5 * width, height, 0.5 * width})};
  return start;
}

Start filled_cube(const Box& body, std::uint32_t count, const FilledCube& cube, std::uint64_t seed) {
  Triple sides = sides_of(body);
  const Triple middle = middle_of(body);
  // A flat mesh has no volume, so it counts as a thin sheet for the fill.
  const double longest = std::max({sides[0], sides[1], sides[2]});
  for (double& side : sides) side = std::max(side, 1e-3 * longest);
  const double volume = sides[0] * sides[1] * sides[2] * std::max<double>(count, 1.0) / cube.fill;
  double width = cube_root(volume);
  Cells cells = cells_for(width, sides, count);
  while (product(cells) == 0) {
    width *= 1.01;
    cells = cells_for(width, sides, count);
  }

  RandomStream random(seed);
  std::vector<std::uint32_t> order(product(cells));
  std::iota(order.begin(), order.end(), 0U);
  Start start;
  start.positions.reserve(count);
  start.velocities.reserve(count);
  for (std::uint32_t n = 0; n < count; ++n) {
    // Fisher and Yates, stopped after the required number of bodies.
    std::swap(order[n], order[n + random.below(static_cast<std::uint32_t>(order.size() - n))]);
    const std::uint64_t at = order[n];
    const Cells cell{at % cells[0], at / cells[0] % cells[1], at / (cells[0] * cells[1])};
    Triple p;
    for (int k = 0; k < 3; ++k) {
      const double side = width / static_cast<double>(cells[k]);
      const double spare = side - sides[k];
      p[k] =
          (static_cast<double>(cell[k]) + 0.5) * side - 0.5 * width - middle[k] + random.between(-0.45, 0.45) * spare;
    }
    start.positions.push_back(rounded_start(p));
    const RandomStream::Direction d = random.direction();
    const double speed = random.between(0.0, cube.top_speed_m_s);
    start.velocities.push_back(rounded_start({speed * d.x, speed * d.y, speed * d.z}));
  }
  const auto half = static_cast<float>(0.5 * width);
  start.domain = {{-half, -half, -half}, {half, half, half}};
  return start;
}

}  // namespace broadside::datasets
