// Scenes for which engines agree on no answer: the outcome is reported, and laws of mechanics judge it.
#include <array>

#include "datasets/circle.hpp"
#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

// A rough rod slides on its tip with mu = 2. From 4/3 on, a thin rod has no solution as a rigid body.
Scene painleve() {
  Scene scene = rigid_scene("reported", 1.0 / 240.0, 1.0);
  constexpr double kLength = 1.0;
  constexpr double kThick = 0.02;
  const Turn lean = turn_by(3.14159265358979323846 / 3.0);
  const double half_height = 0.5 * (kLength * lean.sine + kThick * lean.cosine);
  core::Body& b = add_box(scene, {kLength, kThick, kThick}, {0, static_cast<float>(half_height), 0});
  b.orientation = about_z(lean.cosine, false);
  b.velocity = {-3, 0, 0};
  set_surfaces(scene, 2.0, 0.0);
  return scene;
}

Scene cradle() {
  Scene scene = rigid_scene("reported", 1.0 / 480.0, 1.0);
  scene.gravity_m_s2 = {};
  add_ball(scene, 0.25, {-1, 10, 0}).velocity = {2, 0, 0};
  for (int k = 0; k < 4; ++k) add_ball(scene, 0.25, {0.5F * static_cast<float>(k), 10, 0});
  set_surfaces(scene, 0.0, 1.0);
  return scene;
}

// A leaning coin that rolls on its rim: w^2 sin(alpha) = 4 g / a while it rolls.
Scene disk() {
  Scene scene = rigid_scene("reported", 1.0 / 1000.0, 2.0);
  constexpr double kRadius = 0.5;
  constexpr double kHalf = 0.02;
  const Turn lean = turn_by(3.14159265358979323846 / 6.0);  // angle from the floor
  const double height = kRadius * lean.sine + kHalf * lean.cosine;
  core::Body& b = add_cylinder(scene, kRadius, kHalf, {0, static_cast<float>(height), 0});
  // Its axis, z, is rotated about x to lean; the axis rotates about the vertical at w.
  const double half_angle = 0.5 * (3.14159265358979323846 / 2.0 - 3.14159265358979323846 / 6.0);
  const Turn half = turn_by(-half_angle);
  b.orientation = {static_cast<float>(half.cosine), static_cast<float>(half.sine), 0, 0};
  // w^2 sin(alpha) = 4 g / a; the body turns about the diameter through the point of contact.
  const double rate = 12.52;  // sqrt(4 g / (a sin(alpha))), rad/s
  b.angular_velocity = {0, static_cast<float>(rate * lean.sine * lean.sine),
                        static_cast<float>(-rate * lean.sine * lean.cosine)};
  set_surfaces(scene, 1.0, 0.0);
  return scene;
}

constexpr std::array<SmallSceneRow, 3> kReportedRows{{
    {"rigid:painleve:rod", "a rough rod slides on its tip, mu = 2: reported; no NaN, no energy gained", painleve},
    {"rigid:billiards:cradle", "a ball onto four in a row: reported, since the rule of impact decides", cradle},
    {"rigid:disk:euler", "a leaning coin that rolls on its rim: reported", disk},
}};

}  // namespace

std::span<const SmallSceneRow> reported_scenes() {
  return kReportedRows;
}

}  // namespace broadside::datasets
