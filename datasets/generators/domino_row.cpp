#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kDominoRowKnobs[] = {
    {"gap", 0.1, 0.0, 10.0, "gap between bodies, as a share of the longest side"},
    {"speed_m_s", 5.0, 0.0, 50.0, "speed of the first body along the row, m/s"},
    {"restitution", 1.0, 0.0, 1.0, "restitution of the bodies"},
    {"topple_m_s", 0.0, 0.0, 50.0,
     "speed of the first body's top, m/s: the body tips over its lower edge toward the others"},
};

// Makes a body tip over its lower edge, toward x. A body that only translates keeps just the velocity.
void tip(core::Body& body, const Triple& sides, double top_m_s) {
  const double turn_rad_s = top_m_s / sides[1];
  body.angular_velocity = {0.0F, 0.0F, static_cast<float>(-turn_rad_s)};
  body.velocity.x += static_cast<float>(0.5 * turn_rad_s * sides[1]);
  body.velocity.y += static_cast<float>(0.5 * turn_rad_s * sides[0]);
}

core::Scene domino(const GivenScene& given) {
  Stage stage(given);
  const double longest = stage.longest();
  const double pitch = stage.sides()[0] + given.knobs[0] * longest;
  for (std::uint32_t n = 0; n < given.count; ++n)
    stage.add_body({n * pitch, 0.5 * stage.sides()[1], 0.0}, {n == 0 ? given.knobs[1] : 0.0, 0.0, 0.0});
  if (given.knobs[3] > 0.0) tip(stage.scene().bodies.front(), stage.sides(), given.knobs[3]);
  for (core::Body& body : stage.scene().bodies) body.material.restitution = static_cast<float>(given.knobs[2]);
  return std::move(stage).finish({-2.0 * longest, 0.0, -2.0 * longest},
                                 {given.count * pitch + 4.0 * longest, 4.0 * longest, 2.0 * longest});
}

}  // namespace

SceneFamily domino_family() {
  return {"domino",
          "domino:MESH:N",
          "domino:domino:20",
          "a row of N bodies; the first is pushed into the others",
          600,
          kDominoRowKnobs,
          domino};
}

}  // namespace broadside::datasets
