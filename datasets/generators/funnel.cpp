#include <algorithm>
#include <utility>

#include "datasets/cube_root.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kFunnelKnobs[] = {
    {"outlet", 1.6, 1.0, 100.0, "width of the opening, in longest sides"},
    {"drop_m", 3.0, 0.0, 1e6, "height of the opening above the floor, m"},
    {"speed_m_s", 1.0, 0.0, 50.0, "sideways speed at the start, in random directions, m/s"},
    {"friction", 0.0, 0.0, 10.0, "friction of all surfaces"},
};

core::Scene funnel(const GivenScene& given) {
  Stage stage(given);
  RandomStream random(given.seed);
  const double longest = stage.longest();
  const double pitch = 1.1 * longest;
  const double step = 0.5 * longest;
  const double outlet = 0.5 * given.knobs[0] * longest;
  const double floor_to_outlet = given.knobs[1];
  // Enough steps to make room for a cube of bodies; each step is as wide as high.
  const double wanted = 0.5 * pitch * std::max(2.0, cube_root(given.count) + 1.0);
  const auto steps = std::max(2, static_cast<int>((wanted - outlet) / step) + 1);
  for (int k = 0; k < steps; ++k) {
    const double inner = outlet + k * step;
    const double outer = inner + 2.0 * step;
    const double low = floor_to_outlet + k * step;
    for (const double side : {-1.0, 1.0}) {
      stage.add_static_box({std::min(side * inner, side * outer), low, -outer},
                           {std::max(side * inner, side * outer), low + step, outer});
      stage.add_static_box({-inner, low, std::min(side * inner, side * outer)},
                           {inner, low + step, std::max(side * inner, side * outer)});
    }
  }
  const double rim = outlet + (steps - 1) * step;
  const double half = rim + 2.0 * step;
  const double top = floor_to_outlet + steps * step;
  const auto columns = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(2.0 * rim / pitch));
  const double shift = 0.45 * (pitch - longest);
  for (std::uint32_t n = 0; n < given.count; ++n) {
    const std::uint32_t layer = n / (columns * columns);
    Triple center{n % columns - 0.5 * (columns - 1), layer + 0.5, n / columns % columns - 0.5 * (columns - 1)};
    for (double& c : center) c = c * pitch + random.between(-shift, shift);
    center[1] += top;
    const RandomStream::Direction d = random.direction();
    stage.add_body(center, {given.knobs[2] * d.x, 0.0, given.knobs[2] * d.z});
  }
  const auto friction = static_cast<float>(given.knobs[3]);
  for (core::Body& body : stage.scene().bodies) body.material = {friction, friction, body.material.restitution};
  const std::uint32_t layers = given.count / (columns * columns) + 2;
  return std::move(stage).finish({-half, 0.0, -half}, {half, top + layers * pitch, half});
}

}  // namespace

SceneFamily funnel_family() {
  return {"funnel",
          "funnel:MESH:N",
          "funnel:cube:50",
          "N bodies fall through a square funnel of static steps; nothing rubs",
          600,
          kFunnelKnobs,
          funnel};
}

}  // namespace broadside::datasets
