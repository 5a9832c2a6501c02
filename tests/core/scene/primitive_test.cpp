// Meshes of a box, a sphere or a capsule count as that primitive. Meshes that are only close to one do not.
#include "core/scene/primitive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/cylinder_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside {
namespace {

using core::PrimitiveKind;

TEST(Primitive, BoxesWithAnyCutAreBoxes) {
  for (const int cut : {1, 3, 8}) {
    const auto found = core::primitive_of(datasets::box_mesh({0.1, 2.0, 0.7}, {cut, 1, 2}).value());
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->kind, PrimitiveKind::kBox);
    EXPECT_EQ(found->half_extents, (core::Vec3{0.05F, 1.0F, 0.35F}));
    EXPECT_EQ(found->facet_gap_m, 0.0);
  }
}

TEST(Primitive, SpheresTellHowFarTheirFacetsLieInside) {
  const auto found = core::primitive_of(datasets::sphere_mesh(0.5, 8).value());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->kind, PrimitiveKind::kSphere);
  EXPECT_NEAR(found->radius_m, 0.5, 1e-7);
  // Facets subtend about 63.4 / 8 degrees a side: sagitta 0.5 (1 - cos(4.6 degrees)) at their middles.
  EXPECT_NEAR(found->facet_gap_m, 0.5 * (1.0 - std::cos(0.08)), 0.0015);
}

TEST(Primitive, Capsules) {
  const core::Mesh mesh = datasets::capsule_mesh(0.25, 0.5, 8).value();
  EXPECT_EQ(mesh.vertices.size(), 4U * 64U + 4U * 8U + 2U);
  EXPECT_EQ(mesh.triangles.size(), 8U * 64U + 8U * 8U);
  const auto found = core::primitive_of(mesh);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->kind, PrimitiveKind::kCapsule);
  EXPECT_EQ(found->axis, 2);
  EXPECT_EQ(found->radius_m, 0.25F);
  EXPECT_EQ(found->half_length_m(), 0.5F);
  EXPECT_TRUE(core::is_convex(mesh));
}

TEST(Primitive, CapsuleIsClosedAndTurnsOutward) {
  const core::Mesh mesh = datasets::capsule_mesh(0.25, 0.5, 4).value();
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const core::Vec3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
    six_volumes += static_cast<double>(p.x) * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
                   p.z * (q.x * r.y - q.y * r.x);
  }
  const double pi = std::acos(-1.0);
  const double whole = pi * 0.0625 * 1.0 + 4.0 / 3.0 * pi * 0.015625;
  EXPECT_GT(six_volumes / 6.0, 0.85 * whole);
  EXPECT_LT(six_volumes / 6.0, whole);
}

TEST(Primitive, LookalikesAreNone) {
  EXPECT_FALSE(core::primitive_of(datasets::lumpy_mesh(1280, 3).value()).has_value());
  EXPECT_FALSE(core::primitive_of(datasets::sphere_mesh(0.5, 1).value()).has_value()) << "an icosahedron";
  core::Mesh off_center = datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value();
  for (core::Vec3& v : off_center.vertices) v.x += 0.25F;
  EXPECT_FALSE(core::primitive_of(off_center).has_value());
  core::Mesh open = datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value();
  open.triangles.pop_back();
  EXPECT_FALSE(core::primitive_of(open).has_value());
  core::Mesh dented = datasets::sphere_mesh(0.5, 8).value();
  dented.vertices[17] = 0.99F * dented.vertices[17];
  EXPECT_FALSE(core::primitive_of(dented).has_value());
}

TEST(Primitive, ACylinderIsOneAlongAnyAxis) {
  const core::Mesh along_z = datasets::cylinder_mesh(0.5, 0.125, 32).value();
  for (const int axis : {0, 1, 2}) {
    core::Mesh mesh = along_z;
    for (core::Vec3& v : mesh.vertices) {
      const core::Vec3 from = v;
      v[(axis + 1) % 3] = from.x;
      v[(axis + 2) % 3] = from.y;
      v[axis] = from.z;
    }
    const auto found = core::primitive_of(mesh);
    ASSERT_TRUE(found.has_value()) << axis;
    EXPECT_EQ(found->kind, PrimitiveKind::kCylinder);
    EXPECT_EQ(found->axis, axis);
    EXPECT_FLOAT_EQ(found->radius_m, 0.5F);
    EXPECT_FLOAT_EQ(found->half_length_m(), 0.125F);
    // Facets of a polygon of n corners lie inside the circle by r (1 - cos(pi / n)).
    EXPECT_NEAR(found->facet_gap_m, 0.5 * (1.0 - std::cos(std::numbers::pi / 32)), 1e-7);
  }
}

TEST(Primitive, WhatOnlyResemblesACylinderIsNone) {
  core::Mesh waist = datasets::cylinder_mesh(0.5, 1.0, 32).value();
  waist.vertices[4] = 0.9F * waist.vertices[4];
  EXPECT_FALSE(core::primitive_of(waist).has_value());
  core::Mesh cone = datasets::cylinder_mesh(0.5, 1.0, 32).value();
  for (core::Vec3& v : cone.vertices)
    if (v.z > 0.0F) v = {0.5F * v.x, 0.5F * v.y, v.z};
  EXPECT_FALSE(core::primitive_of(cone).has_value());
  core::Mesh pushed = datasets::cylinder_mesh(0.5, 1.0, 32).value();
  pushed.vertices[1].z = 0.5F;  // the middle of an end
  EXPECT_FALSE(core::primitive_of(pushed).has_value());
}

TEST(Primitive, ConvexBodies) {
  EXPECT_TRUE(core::is_convex(datasets::sphere_mesh(0.5, 1).value()));
  EXPECT_TRUE(core::is_convex(datasets::sphere_mesh(0.5, 8).value()));
  EXPECT_FALSE(core::is_convex(datasets::lumpy_mesh(320, 3).value()));
}

}  // namespace
}  // namespace broadside
