// The velocity that pushes overlapping bodies apart is not kept: core/method/rigid/pushed_apart.hpp.
#include "core/method/rigid/pushed_apart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

constexpr float kSide_m = 0.5F;
constexpr float kDeep_m = 0.04F;

// Ten cubes of 1 kg at rest, each overlapping the next by kDeep_m, along x or upward.
PipelineRig overlapping_row(core::Vec3 along, core::Vec3 gravity_m_s2) {
  PipelineRig rig;
  rig.scene.gravity_m_s2 = gravity_m_s2;
  rig.options.make_solver = [](const core::Scene&) { return reference::make_contact_solver({}); };
  const std::uint32_t cube = rig.box(kSide_m, kSide_m, kSide_m);
  for (int k = 0; k < 10; ++k) {
    const float at_m = static_cast<float>(k) * (kSide_m - kDeep_m);
    core::Body& body = rig.add(cube, at_m * along + core::Vec3{0, 0.5F * kSide_m, 0}, 1.0F);
    body.material = {0.0F, 0.0F, 0.0F};
  }
  return rig;
}

double deepest_m(const core::FrameRecord& frame) {
  double deepest = 0.0;
  for (const core::ContactPoint& p : frame.points) deepest = std::max(deepest, -static_cast<double>(p.gap_m));
  return deepest;
}

double kinetic_j(const core::FrameRecord& frame) {
  double sum = 0.0;
  for (const core::Vec3 v : frame.velocity) sum += 0.5 * static_cast<double>(core::dot(v, v));
  return sum;
}

// Before, the energy of the row was 8.1 J after the first step.
TEST(PushedApart, BodiesAtRestPartAndRestAgain) {
  const auto frames = overlapping_row({1, 0, 0}, {0, 0, 0}).run(60);
  EXPECT_GT(deepest_m(frames.front()), 0.03);
  EXPECT_LT(deepest_m(frames.back()), 1e-4);
  for (const core::FrameRecord& frame : frames) EXPECT_EQ(kinetic_j(frame), 0.0);
}

// Cubes that strike the floor while the row parts. A corner ends each substep on the floor but for what rounding and
// its arc leave. Before, that gap made relaxation leave the corner out after the impulse that had stopped it was taken
// back: such cubes turned along the floor, and went on downward until the row had parted.
TEST(PushedApart, WhatStrikesTheFloorMeanwhileBounces) {
  struct Strike {
    float spin_rad_s;
    float tilt_rad;
    float friction;
  };
  for (const Strike& strike : {Strike{0.0F, 0.5F, 0.0F}, Strike{3.0F, 0.3F, 0.0F}, Strike{9.0F, 0.3F, 0.6F}}) {
    PipelineRig rig = overlapping_row({1, 0, 0}, {0, 0, 0});
    core::Body& cube =
        rig.add(rig.scene.bodies.front().mesh, {0, 0.4F, 20}, 1.0F, {0, -2, 0}, {0, 0, strike.spin_rad_s});
    cube.orientation = {std::cos(strike.tilt_rad / 2), 0, 0, std::sin(strike.tilt_rad / 2)};
    cube.material = {strike.friction, strike.friction, 0.5F};
    rig.scene.face_material = cube.material;
    const auto frames = rig.run(4);
    EXPECT_GT(deepest_m(frames.back()), 0.01) << "the row still parts";
    EXPECT_GT(frames.back().velocity[10].y, 0.0F) << strike.spin_rad_s;
  }
}

// The height of the uppermost cube of a column that stands.
constexpr double kStanding_m = 9.5 * static_cast<double>(kSide_m);

double highest_of_tenth_m(const std::vector<core::FrameRecord>& frames) {
  double highest_m = 0.0;
  for (const core::FrameRecord& frame : frames)
    highest_m = std::max(highest_m, static_cast<double>(frame.position[9].y));
  return highest_m;
}

// A column of overlapping cubes rises until they part, and then stands: no faster than 1 % of what a fall of 4 cm
// gives.
TEST(PushedApart, AColumnRisesWithoutJumping) {
  const auto frames = overlapping_row({0, 1, 0}, {0, -9.81F, 0}).run(120);
  EXPECT_GT(deepest_m(frames.front()), 0.03);
  EXPECT_LT(deepest_m(frames.back()), 1e-3);
  EXPECT_LT(highest_of_tenth_m(frames), kStanding_m + 0.01);
}

// The same column while another cube falls far away, and pushes are kept.
std::vector<core::FrameRecord> column_beside_a_fall(const core::SoftSettings& settings) {
  PipelineRig rig = overlapping_row({0, 1, 0}, {0, -9.81F, 0});
  rig.options.make_solver = [settings](const core::Scene&) { return reference::make_soft_solver(settings); };
  rig.add(rig.scene.bodies.front().mesh, {20, 30, 0}, 1.0F, {0, -1, 0});
  return rig.run(60);
}

// Sweeps continue after the pushes although nothing bounces. Without these sweeps the pushes would stay as speed.
TEST(PushedApart, AColumnRisesWithoutJumpingWhileSomethingFalls) {
  const auto frames = column_beside_a_fall({});
  EXPECT_LT(deepest_m(frames.back()), 1e-3);
  EXPECT_LT(highest_of_tenth_m(frames), kStanding_m + 0.01);
  core::SoftSettings kept;
  kept.even.begins_of_small = 0.0F;
  EXPECT_GT(highest_of_tenth_m(column_beside_a_fall(kept)), kStanding_m + 0.2);
}

}  // namespace
}  // namespace broadside::tests
