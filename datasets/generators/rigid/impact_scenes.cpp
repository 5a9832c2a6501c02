// One impact without gravity.
#include <array>

#include "datasets/circle.hpp"
#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

constexpr double kImpactStep_s = 1.0 / 480.0;
constexpr float kImpactRadius_m = 0.25F;

Scene weightless(std::string answer, double seconds) {
  Scene scene = rigid_scene(std::move(answer), kImpactStep_s, seconds);
  scene.gravity_m_s2 = {};
  return scene;
}

// The lower end of a smooth rod at 30 degrees hits the floor.
Scene rod() {
  Scene scene = weightless("rod-impact", 0.25);
  constexpr double kLength = 2.0;
  constexpr double kThick = 0.02;
  const Turn lean = turn_by(3.14159265358979323846 / 6.0);
  const double half_height = 0.5 * (kLength * lean.sine + kThick * lean.cosine);
  core::Body& b = add_box(scene, {kLength, kThick, kThick}, {0, static_cast<float>(half_height + 0.05), 0});
  b.orientation = about_z(lean.cosine, false);
  b.velocity = {0, -1, 0};
  set_surfaces(scene, 0.0, 0.5);
  return scene;
}

// Elastic smooth balls of one mass; the first moves at 2 m/s along x, `offset_m` beside the center of the second.
Scene two_balls(float offset_m) {
  Scene scene = weightless("billiards", 1.0);
  add_ball(scene, kImpactRadius_m, {-1, 10, 0}).velocity = {2, 0, 0};
  add_ball(scene, kImpactRadius_m, {0, 10 - offset_m, 0});
  set_surfaces(scene, 0.0, 1.0);
  return scene;
}
Scene central() {
  return two_balls(0.0F);
}
Scene off_center() {
  return two_balls(0.25F);
}

// A ball hits two balls that touch each other, in the middle: it keeps -1/5 of its speed, and each of them takes 2/5
// sqrt(3).
Scene three_balls() {
  Scene scene = weightless("three-balls", 1.0);
  add_ball(scene, kImpactRadius_m, {-1, 10, 0}).velocity = {2, 0, 0};
  add_ball(scene, kImpactRadius_m, {0, 10.25F, 0});
  add_ball(scene, kImpactRadius_m, {0, 9.75F, 0});
  set_surfaces(scene, 0.0, 1.0);
  return scene;
}

constexpr std::array<SmallSceneRow, 4> kImpactRows{{
    {"rigid:rod:end-impact", "a slanted rod meets the floor: J = (1 + e) m v / (1 + 3 cos^2 phi)", rod},
    {"rigid:billiards:central", "two equal elastic balls head on: they exchange velocities", central},
    {"rigid:billiards:off-center", "two equal elastic balls off center: they part at a right angle", off_center},
    {"rigid:billiards:three", "a ball hits two that touch: it bounces back at a fifth of its speed", three_balls},
}};

}  // namespace

std::span<const SmallSceneRow> impact_scenes() {
  return kImpactRows;
}

}  // namespace broadside::datasets
