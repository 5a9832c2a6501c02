#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kDominoRowKnobs[] = {
    {"gap", 0.1, 0.0, 10.0, "between bodies, as a share of the longest side"},
    {"speed_m_s", 5.0, 0.0, 50.0, "of the first, along the row, m/s"},
    {"restitution", 1.0, 0.0, 1.0, "of the bodies"},
};

core::Scene domino(const GivenScene& given) {
  Stage stage(given);
  const double longest = stage.longest();
  const double pitch = stage.sides()[0] + given.knobs[0] * longest;
  for (std::uint32_t n = 0; n < given.count; ++n)
    stage.add_body({n * pitch, 0.5 * stage.sides()[1], 0.0}, {n == 0 ? given.knobs[1] : 0.0, 0.0, 0.0});
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
