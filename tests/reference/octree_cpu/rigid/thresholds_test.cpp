// One setting for bodies of a millimeter and of a kilometer: RIGID 8.6. The bar: no body is deeper in another than a
// thousandth of the smaller one's side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/contact.hpp"
#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

constexpr double kBar = 1e-3;

PipelineRig rig_of_still_boxes(bool is_fixed) {
  PipelineRig rig;
  rig.options.make_solver = [is_fixed](const core::Scene& scene) {
    return reference::make_soft_solver(is_fixed ? core::with_fixed_thresholds({}, scene) : core::SoftSettings{});
  };
  return rig;
}

core::Body& add_cube(PipelineRig& rig, std::uint32_t mesh, core::Vec3 x, float side_m) {
  core::Body& body = rig.add(mesh, x, 1000.0F * side_m * side_m * side_m);
  body.material.restitution = 0.0F;
  return body;
}

// The depth of the deepest point of all frames, in sides of the smaller body.
double deepest_share(const PipelineRig& rig, const std::vector<float>& sides_m, std::uint32_t steps) {
  double deepest = 0.0;
  for (const core::FrameRecord& f : rig.run(steps))
    for (const core::ContactPoint& p : f.points) {
      const float side = core::is_face(p.b) ? sides_m[p.a] : std::min(sides_m[p.a], sides_m[p.b]);
      deepest = std::max(deepest, -static_cast<double>(p.gap_m) / static_cast<double>(side));
    }
  return deepest;
}

// Columns of three cubes that fall a twentieth of their size onto each other. Steps are such that a cube falls by the
// same share of its side in each.
double deepest_of_size(float side_m, bool is_fixed) {
  PipelineRig rig = rig_of_still_boxes(is_fixed);
  rig.scene.dt_s = std::sqrt(side_m) / 60.0F;
  rig.scene.domain = {{-20 * side_m, 0, -20 * side_m}, {20 * side_m, 40 * side_m, 20 * side_m}};
  const std::uint32_t cube =
      rig.box(static_cast<double>(side_m), static_cast<double>(side_m), static_cast<double>(side_m));
  std::vector<float> sides;
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 3; ++y) {
      const float layer = static_cast<float>(y);
      add_cube(rig, cube, {side_m * (1.1F * static_cast<float>(x) + 0.03F * layer), side_m * (0.5F + 1.05F * layer), 0},
               side_m);
      sides.push_back(side_m);
    }
  return deepest_share(rig, sides, 120);
}

TEST(Thresholds, OneSettingServesAMillimeterAMeterAndAKilometer) {
  for (const float side : {0.001F, 1.0F, 1000.0F}) EXPECT_LT(deepest_of_size(side, false), kBar) << side;
}

TEST(Thresholds, FixedOnesDoNotServeAMillimeter) {
  EXPECT_GT(deepest_of_size(0.001F, true), kBar);
}

// Cubes of a millimeter, a meter and a kilometer, each on the floor and one on it, in one scene.
double deepest_of_far_sizes(bool is_fixed) {
  PipelineRig rig = rig_of_still_boxes(is_fixed);
  rig.scene.dt_s = std::sqrt(0.001F) / 60.0F;
  rig.scene.domain = {{-10, 0, -1000}, {4000, 4000, 1000}};
  std::vector<float> sides;
  float x = 0.0F;
  for (const float side : {0.001F, 1.0F, 1000.0F}) {
    const std::uint32_t cube = rig.box(static_cast<double>(side), static_cast<double>(side), static_cast<double>(side));
    for (int k = 0; k < 2; ++k) {
      add_cube(rig, cube, {x + 0.1F * side * static_cast<float>(k), side * (0.5F + static_cast<float>(k)), 0}, side);
      sides.push_back(side);
    }
    x += 1000.0F;
  }
  return deepest_share(rig, sides, 240);
}

TEST(Thresholds, OneSettingServesAMillimeterBesideAKilometer) {
  EXPECT_LT(deepest_of_far_sizes(false), kBar);
  EXPECT_GT(deepest_of_far_sizes(true), kBar);
}

// Cubes of 0.1 m, 1 cm and 1 mm on one of a meter.
double deepest_of_mixture(bool is_fixed) {
  PipelineRig rig = rig_of_still_boxes(is_fixed);
  std::vector<float> sides;
  add_cube(rig, rig.box(1, 1, 1), {0, 0.5F, 0}, 1.0F);
  sides.push_back(1.0F);
  float row = -0.3F;
  for (const float side : {0.1F, 0.01F, 0.001F}) {
    const std::uint32_t cube = rig.box(static_cast<double>(side), static_cast<double>(side), static_cast<double>(side));
    for (int k = 0; k < 4; ++k) {
      add_cube(rig, cube, {0.2F * static_cast<float>(k) - 0.3F, 1.0F + 0.51F * side, row}, side);
      sides.push_back(side);
    }
    row += 0.3F;
  }
  return deepest_share(rig, sides, 120);
}

TEST(Thresholds, OneSettingServesAThousandToOneInOneHeap) {
  EXPECT_LT(deepest_of_mixture(false), kBar);
}

TEST(Thresholds, FixedOnesDoNotServeAThousandToOne) {
  EXPECT_GT(deepest_of_mixture(true), kBar);
}

// A cube of 8 kg falls at 9 m/s on one of 16 g, which lies askew on another of 8 kg. Returns how deep the small one
// ends in either, in its sides.
double deepest_under_a_heavy_one(const core::SoftSettings& settings) {
  PipelineRig rig;
  rig.options.make_solver = [settings](const core::Scene&) { return reference::make_soft_solver(settings); };
  const std::uint32_t large = rig.box(2, 2, 2);
  rig.add(large, {0, 1, 0}, 8.0F);
  rig.add(rig.box(0.25, 0.25, 0.25), {0.3F, 2.2F, 0.1F}, 0x1p-6F, {}, {5, -13, 27});
  rig.add(large, {0, 3.5F, 0}, 8.0F, {0, -9, 0});
  return deepest_share(rig, {2.0F, 0.25F, 2.0F}, 40);
}

// Neither stiffer contacts nor the patches of the step's start were enough.
TEST(Thresholds, ALightBodyIsNotCrushedByAHeavyOneThatFalls) {
  core::SoftSettings once;
  once.lively = once.calm = {1, once.even};
  EXPECT_GT(deepest_under_a_heavy_one(once), 0.05);
  EXPECT_LT(deepest_under_a_heavy_one({}), 0.02);
}

}  // namespace
}  // namespace broadside::tests
