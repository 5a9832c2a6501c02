#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kDrumKnobs[] = {
    {"fill", 0.4, 0.05, 0.7, "share of the drum that the bodies and their gaps take"},
    {"depth", 2.2, 1.1, 100.0, "depth of the drum, in longest sides"},
};

constexpr double kPitch = 1.1;  // distance of the bodies at the start, in longest sides

// Centers of the grid cells within the radius, in the plane of the drum's round side, from below.
std::vector<std::array<double, 2>> cells_within(double radius, double pitch) {
  std::vector<std::array<double, 2>> cells;
  const auto most = static_cast<int>(radius / pitch) + 1;
  for (int row = -most; row <= most; ++row)
    for (int column = -most; column <= most; ++column) {
      const double x = std::abs(column * pitch) + 0.5 * pitch;
      const double y = std::abs(row * pitch) + 0.5 * pitch;
      if (x * x + y * y <= radius * radius) cells.push_back({column * pitch, row * pitch});
    }
  return cells;
}

core::Scene drum(const GivenScene& given) {
  Stage stage(given);
  RandomStream random(given.seed);
  const double longest = stage.longest();
  const double pitch = kPitch * longest;
  const double depth = given.knobs[1] * longest;
  const auto layers = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(depth / pitch));
  double radius =
      std::sqrt(given.count * pitch * pitch * pitch / (std::numbers::pi * depth * given.knobs[0])) + longest;
  std::vector<std::array<double, 2>> cells = cells_within(radius, pitch);
  while (cells.size() * layers < given.count) cells = cells_within(radius *= 1.05, pitch);

  // The wall: square cells of half a body. A cell's corners are up to 0.71 of its side from its center, so no cell
  // reaches inside the radius.
  const double cell = 0.5 * longest;
  const auto most = static_cast<int>(radius / cell) + 4;
  for (int row = -most; row <= most; ++row)
    for (int column = -most; column <= most; ++column) {
      const double x = column * cell;
      const double y = row * cell;
      const double distance = std::sqrt(x * x + y * y);
      if (distance < radius + 0.71 * cell || distance >= radius + 2.21 * cell) continue;
      stage.add_static_box({x - 0.5 * cell, y - 0.5 * cell, -0.5 * depth},
                           {x + 0.5 * cell, y + 0.5 * cell, 0.5 * depth});
    }
  const double shift = 0.45 * (pitch - longest);
  for (std::uint32_t n = 0; n < given.count; ++n) {
    const std::array<double, 2>& at = cells[n / layers];
    const double z = (n % layers - 0.5 * (layers - 1)) * pitch;
    stage.add_body({at[0] + random.between(-shift, shift), at[1] + random.between(-shift, shift),
                    z + random.between(-shift, shift)});
  }
  const double half = radius + 3.5 * cell;
  return std::move(stage).finish({-half, -half, -0.5 * depth}, {half, half, 0.5 * depth});
}

}  // namespace

SceneFamily drum_family() {
  return {"drum",
          "drum:MESH:N",
          "drum:cube:50",
          "N bodies fall inside a horizontal drum of static boxes, which is at rest",
          600,
          kDrumKnobs,
          drum};
}

}  // namespace broadside::datasets
