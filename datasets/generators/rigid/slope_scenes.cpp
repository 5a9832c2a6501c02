// A box on a plane: it slides, sticks or tips. Pairs lie 1 % to either side of a threshold.
#include <array>

#include "datasets/circle.hpp"
#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

constexpr double kSlopeStep_s = 1.0 / 240.0;
constexpr double kSlopeMore = 1.01;  // 1 % above a threshold
constexpr double kG = 9.81;          // magnitude of kGravity

// A flat box on a plane of this slope.
Scene on_slope(std::string answer, double tangent, double friction, std::array<double, 3> sides, double seconds) {
  Scene scene = rigid_scene(std::move(answer), kSlopeStep_s, seconds);
  const Slope slope = slope_of(tangent);
  add_box(scene, sides, static_cast<float>(0.5 * sides[1]) * slope.normal).orientation = slope.orientation;
  add_slope(scene, slope);
  set_surfaces(scene, friction, 0.0);
  return scene;
}

constexpr std::array<double, 3> kFlat{1.0, 0.25, 1.0};

// tan(theta) = 1/2.
Scene slides() {
  return on_slope("incline", 0.5, 0.5 / kSlopeMore, kFlat, 2.0);
}
Scene sticks() {
  return on_slope("stands", 0.5, 0.5 * kSlopeMore, kFlat, 4.0);
}

constexpr std::array<double, 3> kTall{0.5, 1.0, 0.5};  // b / h = 1/2
constexpr double kRough = 1.0;

Scene tips_on_slope() {
  return on_slope("falls", 0.5 * kSlopeMore, kRough, kTall, 3.0);
}
Scene stands_on_slope() {
  return on_slope("stands", 0.5 / kSlopeMore, kRough, kTall, 3.0);
}

// Pushed at its center of mass along x, on the floor.
Scene pushed(std::string answer, double share_of_weight, double friction) {
  Scene scene = rigid_scene(std::move(answer), kSlopeStep_s, 3.0);
  add_box(scene, kTall, {0, 0.5F, 0});
  set_surfaces(scene, friction, 0.0);
  scene.wrenches = {{0, core::WrenchAxes::kWorld, {static_cast<float>(share_of_weight * kG), 0, 0}, {}}};
  return scene;
}

Scene tips() {
  return pushed("falls", 0.5 * kSlopeMore, kRough);
}
Scene does_not_tip() {
  return pushed("stands", 0.5 / kSlopeMore, kRough);
}
// mu < b / h: it slides before it would tip.
Scene slides_first() {
  return pushed("incline", 0.45, 0.4);
}

// v0^2 / (2 mu g) in every heading: 4 m/s, mu = 1/2.
template <std::uint32_t heading>
Scene slide_heading() {
  Scene scene = rigid_scene("slide", kSlopeStep_s, 1.25);
  const Turn turn = part_of_circle(heading, 16);
  add_box(scene, kFlat, {0, 0.125F, 0}).velocity = {static_cast<float>(4.0 * turn.cosine), 0,
                                                    static_cast<float>(4.0 * turn.sine)};
  set_surfaces(scene, 0.5, 0.0);
  return scene;
}

// Smooth wall x = 0 and floor; the ladder leans at 60 degrees and starts at rest. Its lower corners touch them.
Scene ladder() {
  Scene scene = rigid_scene("ladder", 1.0 / 1000.0, 1.0);
  constexpr double kLength = 2.0;
  constexpr double kThick = 0.02;
  const Turn lean = turn_by(3.14159265358979323846 / 3.0);
  // The corners of its underside touch the wall and the floor.
  const double x = 0.5 * (kLength * lean.cosine + kThick * lean.sine);
  const double y = 0.5 * (kLength * lean.sine + kThick * lean.cosine);
  add_box(scene, {kLength, kThick, 0.5}, {static_cast<float>(x), static_cast<float>(y), 0}).orientation =
      about_z(lean.cosine, true);
  scene.domain.min.x = 0.0F;
  set_surfaces(scene, 0.0, 0.0);
  return scene;
}

constexpr std::array<SmallSceneRow, 24> kSlopeRows{{
    {"rigid:incline:slide", "a box on a plane with mu 1 % below tan(theta): g (sin - mu cos)", slides},
    {"rigid:incline:stick", "a box on a plane with mu 1 % above tan(theta): it rests", sticks},
    {"rigid:tip:incline-tips", "a tall box on a plane 1 % steeper than b / h: it tips", tips_on_slope},
    {"rigid:tip:incline-stands", "a tall box on a plane 1 % less steep than b / h: it stands", stands_on_slope},
    {"rigid:tip:push-tips", "a tall box pushed 1 % harder than m g b / h: it tips", tips},
    {"rigid:tip:push-stands", "a tall box pushed 1 % less than m g b / h: it stands", does_not_tip},
    {"rigid:tip:push-slides", "a tall box pushed where mu < b / h: it slides upright", slides_first},
    {"rigid:ladder", "a ladder on a smooth wall and floor: leaves the wall at 2/3 of its starting sine", ladder},
    {"rigid:slide:heading-0", "a box slides v0^2 / (2 mu g) along x", slide_heading<0>},
    {"rigid:slide:heading-1", "the same at 1/16 of the circle", slide_heading<1>},
    {"rigid:slide:heading-2", "the same at 2/16 of the circle", slide_heading<2>},
    {"rigid:slide:heading-3", "the same at 3/16 of the circle", slide_heading<3>},
    {"rigid:slide:heading-4", "the same at 4/16 of the circle", slide_heading<4>},
    {"rigid:slide:heading-5", "the same at 5/16 of the circle", slide_heading<5>},
    {"rigid:slide:heading-6", "the same at 6/16 of the circle", slide_heading<6>},
    {"rigid:slide:heading-7", "the same at 7/16 of the circle", slide_heading<7>},
    {"rigid:slide:heading-8", "the same at 8/16 of the circle", slide_heading<8>},
    {"rigid:slide:heading-9", "the same at 9/16 of the circle", slide_heading<9>},
    {"rigid:slide:heading-10", "the same at 10/16 of the circle", slide_heading<10>},
    {"rigid:slide:heading-11", "the same at 11/16 of the circle", slide_heading<11>},
    {"rigid:slide:heading-12", "the same at 12/16 of the circle", slide_heading<12>},
    {"rigid:slide:heading-13", "the same at 13/16 of the circle", slide_heading<13>},
    {"rigid:slide:heading-14", "the same at 14/16 of the circle", slide_heading<14>},
    {"rigid:slide:heading-15", "the same at 15/16 of the circle", slide_heading<15>},
}};

}  // namespace

std::span<const SmallSceneRow> slope_scenes() {
  return kSlopeRows;
}

}  // namespace broadside::datasets
