// Stacked bodies that stand or fall. Pairs lie 1 % to either side of a threshold.
#include <array>
#include <cmath>

#include "datasets/circle.hpp"
#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

constexpr double kStructureStep_s = 1.0 / 60.0;
constexpr double kMinute_s = 60.0;
constexpr double kStructureMore = 1.01;  // 1 % above a threshold
constexpr double kPi = 3.14159265358979323846;

Scene blocks_stacked(std::uint32_t count, double top_mass_kg) {
  Scene scene = rigid_scene("stands", kStructureStep_s, kMinute_s);
  for (std::uint32_t k = 0; k < count; ++k)
    add_box(scene, {1.0, 1.0, 1.0}, {0, 0.5F + static_cast<float>(k), 0}, k + 1 == count ? top_mass_kg : 1.0);
  set_surfaces(scene, 0.5, 0.0);
  return scene;
}
Scene stack_5() {
  return blocks_stacked(5, 1.0);
}
Scene stack_20() {
  return blocks_stacked(20, 1.0);
}
Scene heavy_on_light() {
  return blocks_stacked(2, 1000.0);
}

// Two cards that lean at 25 degrees from the vertical, cut vertically where they meet and horizontally where they
// stand. The least friction that statics allows at the floor has the contact force at the top of the joint and the
// floor's force at the inner edge. It is (x_foot - x_center) / y_top of the weight: half the tangent of the angle for
// thin cards.
Scene tent(double share, std::string answer) {
  constexpr double kLength = 1.0;
  constexpr double kThick = 0.02;
  const Turn lean = turn_by(25.0 / 180.0 * kPi);
  const double foot = kLength * lean.sine;
  const double far_foot = foot + kThick / lean.cosine;
  const double under = kLength * lean.cosine;
  const double top = under + kThick / lean.sine;
  // The center of the trapezoid: the outer triangle minus the inner one, which have the same shape.
  const double outer = far_foot * top;
  const double inner = foot * under;
  const double center = (outer * far_foot - inner * foot) / (3.0 * (outer - inner));
  const double least_friction = (foot - center) / top;
  Scene scene = rigid_scene(std::move(answer), 1.0 / 240.0, 3.0);
  add_prism(scene, {{foot, 0.0}, {far_foot, 0.0}, {0.0, top}, {0.0, under}}, 0.5);
  add_prism(scene, {{-foot, 0.0}, {0.0, under}, {0.0, top}, {-far_foot, 0.0}}, 0.5);
  set_surfaces(scene, share * least_friction, 0.0);
  return scene;
}
Scene tent_stands() {
  return tent(kStructureMore, "stands");
}
Scene tent_falls() {
  return tent(1.0 / kStructureMore, "falls");
}

// Books over the edge of a table. The i-th book from the top is at most L / (2 i) beyond the one below.
Scene overhang(std::uint32_t books, double share, std::string answer) {
  constexpr double kLength = 1.0;
  constexpr double kHigh = 0.125;
  Scene scene = rigid_scene(std::move(answer), 1.0 / 240.0, 4.0);
  double end = 0.0;  // of the lowest book, measured from the table's edge at x = 0
  for (std::uint32_t i = books; i >= 1; --i) {
    end += share * kLength / (2.0 * i);
    add_box(scene, {kLength, kHigh, 0.5},
            {static_cast<float>(end - 0.5 * kLength), static_cast<float>(1.0 + kHigh * (books - i + 0.5)), 0});
  }
  add_box(scene, {2.0, 1.0, 2.0}, {-1, 0.5F, 0}, kStaticMass);
  set_surfaces(scene, 0.5, 0.0);
  return scene;
}
Scene overhang_stands() {
  return overhang(5, 1.0 / kStructureMore, "stands");
}
Scene overhang_falls() {
  return overhang(5, kStructureMore, "falls");
}

// A semicircular arch of n stones with radial joints and straight sides, with a middle line of 1 m radius. The least
// thickness for infinitely many stones is 0.1075 R (Milankovitch, Theorie der Druckkurven, 1907). For 25 and for 7
// stones, whose hinges can lie only in their joints, it is 0.10696 and 0.09570 R, by the same limit analysis.
Scene arch(std::uint32_t stones, double thickness, std::string answer, double seconds) {
  Scene scene = rigid_scene(std::move(answer), 1.0 / 240.0, seconds);
  const double inside = 1.0 - 0.5 * thickness;
  const double outside = 1.0 + 0.5 * thickness;
  const auto joint = [stones](std::uint32_t k) {
    // Both feet must lie on the floor exactly.
    if (k == 0) return Turn{1.0, 0.0};
    return k == stones ? Turn{-1.0, 0.0} : turn_by(kPi * k / stones);
  };
  for (std::uint32_t k = 0; k < stones; ++k) {
    const Turn a = joint(k);
    const Turn b = joint(k + 1);
    add_prism(scene,
              {{inside * a.cosine, inside * a.sine},
               {outside * a.cosine, outside * a.sine},
               {outside * b.cosine, outside * b.sine},
               {inside * b.cosine, inside * b.sine}},
              0.25);
  }
  set_surfaces(scene, 1.0, 0.0);
  return scene;
}
Scene arch_25_stands() {
  return arch(25, 0.10696 * kStructureMore, "stands", 10.0);
}
Scene arch_25_falls() {
  return arch(25, 0.10696 / kStructureMore, "falls", 10.0);
}
Scene arch_7_stands() {
  return arch(7, 0.09570 * kStructureMore, "stands", 5.0);
}
Scene arch_7_falls() {
  return arch(7, 0.09570 / kStructureMore, "falls", 5.0);
}

constexpr std::array<SmallSceneRow, 11> kStructureRows{{
    {"rigid:stack:5", "five cubes stand for a minute", stack_5},
    {"rigid:stack:20", "twenty cubes stand for a minute", stack_20},
    {"rigid:stack:1000-on-1", "1000 kg on 1 kg stands for a minute", heavy_on_light},
    {"rigid:card-tent:stands", "two cards lean on each other, mu 1 % above what statics needs", tent_stands},
    {"rigid:card-tent:falls", "two cards lean on each other, mu 1 % below that: they slide apart", tent_falls},
    {"rigid:overhang:stands", "five books over a table's edge, 1 % less than L/2 (1 + 1/2 + 1/3 + 1/4 + 1/5)",
     overhang_stands},
    {"rigid:overhang:falls", "five books over a table's edge, 1 % more than that", overhang_falls},
    {"rigid:arch:7-stands", "a semicircular arch of 7 stones, 1 % thicker than the thinnest that stands",
     arch_7_stands},
    {"rigid:arch:7-falls", "a semicircular arch of 7 stones, 1 % thinner than the thinnest that stands", arch_7_falls},
    {"rigid:arch:25-stands", "a semicircular arch of 25 stones, 1 % thicker than the thinnest that stands",
     arch_25_stands},
    {"rigid:arch:25-falls", "a semicircular arch of 25 stones, 1 % thinner than the thinnest that stands",
     arch_25_falls},
}};

}  // namespace

std::span<const SmallSceneRow> structure_scenes() {
  return kStructureRows;
}

}  // namespace broadside::datasets
