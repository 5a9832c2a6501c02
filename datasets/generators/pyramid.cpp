#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kPyramidKnobs[] = {
    {"gap", 0.05, 0.0, 0.9, "gap between neighbors of a layer, as a share of the longest side"},
};

core::Scene pyramid(const GivenScene& given) {
  Stage stage(given);
  const double longest = stage.longest();
  const double pitch = (1.0 + given.knobs[0]) * longest;
  std::uint32_t base = 0;
  for (std::uint64_t room = 0; room < given.count; room += std::uint64_t{base} * base) ++base;
  // Layer by layer upward, each one body narrower; the last layers may stay empty.
  std::uint32_t left = given.count;
  for (std::uint32_t layer = 0; left > 0; ++layer) {
    const std::uint32_t side = base - layer;
    const double low = -0.5 * (side - 1) * pitch;
    const double y = (layer + 0.5) * stage.sides()[1];
    for (std::uint32_t cell = 0; cell < side * side && left > 0; ++cell, --left) {
      const std::uint32_t row = cell / side;
      stage.add_body({low + cell % side * pitch, y, low + row * pitch});
    }
  }
  const double half = 0.5 * base * pitch + 2.0 * longest;
  return std::move(stage).finish({-half, 0.0, -half}, {half, (base + 2) * longest, half});
}

}  // namespace

SceneFamily pyramid_family() {
  return {"pyramid",
          "pyramid:MESH:N",
          "pyramid:cube:30",
          "N bodies as a square pyramid, each over the middle of four",
          600,
          kPyramidKnobs,
          pyramid};
}

}  // namespace broadside::datasets
