#include <algorithm>
#include <utility>

#include "datasets/cube_root.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kHopperKnobs[] = {
    {"opening", 1.0, 0.1, 1.0, "share of the bin's width that is open below; a body on the lip stays there"},
    {"drop_m", 2.0, 0.0, 1e6, "height of the bin above the floor, m"},
    {"ground", 4.0, 1.0, 1000.0, "width of the floor, as a multiple of the bin's"},
};

core::Scene hopper(const GivenScene& given) {
  Stage stage(given);
  RandomStream random(given.seed);
  const double longest = stage.longest();
  const double pitch = 1.1 * longest;
  const double thick = 0.5 * longest;
  // The bin is four times as high as wide, or as near to that as the count allows.
  const auto columns = static_cast<std::uint32_t>(cube_root(given.count / 4.0)) + 1;
  const std::uint32_t layers = (given.count + columns * columns - 1) / (columns * columns);
  const double inner = 0.5 * columns * pitch;
  const double low = given.knobs[1];
  const double high = low + (layers + 0.5) * pitch;
  const auto ring = [&](double from, double to, double bottom, double top) {
    for (const double side : {-1.0, 1.0}) {
      stage.add_static_box({std::min(side * from, side * to), bottom, -to},
                           {std::max(side * from, side * to), top, to});
      stage.add_static_box({-from, bottom, std::min(side * from, side * to)},
                           {from, top, std::max(side * from, side * to)});
    }
  };
  ring(inner, inner + thick, low, high);
  const double open = given.knobs[0] * inner;
  if (open < inner) ring(open, inner + thick, low - thick, low);
  const double shift = 0.45 * (pitch - longest);
  for (std::uint32_t n = 0; n < given.count; ++n) {
    const std::uint32_t layer = n / (columns * columns);
    Triple center{n % columns - 0.5 * (columns - 1), layer + 0.5, n / columns % columns - 0.5 * (columns - 1)};
    for (double& c : center) c = c * pitch + random.between(-shift, shift);
    center[1] += low;
    stage.add_body(center);
  }
  const double half = given.knobs[2] * (inner + thick);
  return std::move(stage).finish({-half, 0.0, -half}, {half, high + 2.0 * pitch, half});
}

}  // namespace

SceneFamily hopper_family() {
  return {"hopper",
          "hopper:MESH:N",
          "hopper:sphere:60",
          "N bodies leave an open bin above the floor and make a pile",
          600,
          kHopperKnobs,
          hopper};
}

}  // namespace broadside::datasets
