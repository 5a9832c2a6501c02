// What is derived from a body's shape before the first step.
#include "core/scene/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "core/exact/convex_hull.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside::tests {
namespace {

core::RigidShape shape_of(core::Mesh mesh) {
  core::Scene scene;
  scene.motion = core::Motion::kRigid;
  scene.meshes = {std::make_shared<const core::Mesh>(std::move(mesh))};
  scene.bodies.resize(1);
  auto made = core::make_rigid_bodies(scene);
  EXPECT_TRUE(made.ok()) << made.error().line();
  return made.ok() ? made.value().shapes[0] : core::RigidShape{};
}

core::Mesh moved(core::Mesh mesh) {
  for (core::Vec3& v : mesh.vertices) v = v + core::Vec3{3.0F, -2.0F, 1.0F};
  return mesh;
}

// A box that is moved off the origin counts as a hull, and is as thick as before.
TEST(RigidBodies, AHullIsAsThickAsTheBallAboutItsCenterOfMassThatTouchesTheNearestFace) {
  const core::Mesh box = datasets::box_mesh({0.5, 1.0, 2.0}, {1, 1, 1}).value();
  EXPECT_EQ(shape_of(box).half_thickness_m, 0.25F);
  const core::RigidShape hull = shape_of(moved(box));
  ASSERT_EQ(hull.contact.kind, core::ContactKind::kHull);
  EXPECT_NEAR(hull.half_thickness_m, 0.25, 1e-6);
  EXPECT_EQ(hull.balls.inner_m, hull.half_thickness_m);

  const core::Mesh octahedron =
      *exact::convex_hull({{1, 0, 0}, {-1, 0, 0}, {0, 0.5F, 0}, {0, -0.5F, 0}, {0, 0, 2}, {0, 0, -2}});
  const double to_a_face = 1.0 / std::sqrt(1.0 + 4.0 + 0.25);
  EXPECT_NEAR(shape_of(octahedron).half_thickness_m, to_a_face, 1e-6);
  EXPECT_NEAR(shape_of(moved(octahedron)).half_thickness_m, to_a_face, 1e-6);
}

}  // namespace
}  // namespace broadside::tests
