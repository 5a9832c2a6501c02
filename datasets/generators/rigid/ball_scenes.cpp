// Balls that roll and bounce.
#include <array>

#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

constexpr double kBallStep_s = 1.0 / 480.0;
constexpr double kBallMore = 1.01;  // 1 % above a threshold
constexpr double kBallRadius_m = 0.5;

Scene slip_to_roll() {
  Scene scene = rigid_scene("slip-to-roll", kBallStep_s, 1.0);
  add_ball(scene, kBallRadius_m, {0, 0.5F, 0}).velocity = {3.5F, 0, 0};
  set_surfaces(scene, 0.4, 0.0);
  return scene;
}

// tan(theta) = 1/2: rolls iff mu >= 2/7 tan(theta).
Scene on_slope(double friction) {
  Scene scene = rigid_scene("roll-incline", kBallStep_s, 1.5);
  const Slope slope = slope_of(0.5);
  add_ball(scene, kBallRadius_m, static_cast<float>(kBallRadius_m) * slope.normal);
  add_slope(scene, slope);
  set_surfaces(scene, friction, 0.0);
  return scene;
}
Scene rolls() {
  return on_slope(1.0 / 7.0 * kBallMore);
}
Scene slips() {
  return on_slope(1.0 / 7.0 / kBallMore);
}

// No gravity, so that there is only one impact: (3, -4) m/s on the floor with e = 1/2.
Scene oblique_bounce(double friction) {
  Scene scene = rigid_scene("oblique-bounce", kBallStep_s, 0.5);
  scene.gravity_m_s2 = {};
  add_ball(scene, kBallRadius_m, {0, 1.5F, 0}).velocity = {3, -4, 0};
  set_surfaces(scene, friction, 0.5);
  return scene;
}
// The threshold is mu (1 + e) v_n = 2/7 v_t: mu = 1/7.
Scene oblique_rolls() {
  return oblique_bounce(1.0 / 7.0 * kBallMore);
}
Scene oblique_slips() {
  return oblique_bounce(1.0 / 7.0 / kBallMore);
}

// Comes to rest after sqrt(2 h / g) (1 + e) / (1 - e) = 4.5 s; every impact bounces.
Scene bounce() {
  Scene scene = rigid_scene("bounce", kBallStep_s, 4.0);
  add_ball(scene, kBallRadius_m, {0, 2.5F, 0});
  set_surfaces(scene, 0.5, 0.75);
  scene.parameters.v_threshold_m_s = 0.0F;
  return scene;
}

constexpr std::array<SmallSceneRow, 6> kBallRows{{
    {"rigid:sphere:slip-to-roll", "a ball slips at first, then rolls from 2 v0 / (7 mu g) on, at 5/7 v0", slip_to_roll},
    {"rigid:sphere:roll-incline", "a ball on a plane, mu 1 % above 2/7 tan(theta): 5/7 g sin(theta)", rolls},
    {"rigid:sphere:slip-incline", "a ball on a plane, mu 1 % below 2/7 tan(theta): g (sin - mu cos)", slips},
    {"rigid:sphere:oblique-rolls", "an oblique bounce, mu 1 % above 2/7 v_t / ((1 + e) v_n): J_t = 2/7 m v_t",
     oblique_rolls},
    {"rigid:sphere:oblique-slips", "an oblique bounce, mu 1 % below that: J_t = mu (1 + e) m v_n", oblique_slips},
    {"rigid:bounce", "a ball bounces to e^2 of its height, again and again", bounce},
}};

}  // namespace

std::span<const SmallSceneRow> ball_scenes() {
  return kBallRows;
}

}  // namespace broadside::datasets
