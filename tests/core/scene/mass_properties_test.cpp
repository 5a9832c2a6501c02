// Inertia from meshes: closed forms, the divergence theorem against them, and values that no body can have.
#include "core/scene/mass_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/cylinder_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::tests {
namespace {

using core::MassProperties;
using core::Mesh;

MassProperties properties(const Mesh& mesh, double mass_kg) {
  auto made = core::uniform_mass_properties(mesh, mass_kg);
  EXPECT_TRUE(made.ok()) << made.error().line();
  return made.ok() ? made.value() : MassProperties{};
}

TEST(MassProperties, ABoxHasItsClosedForm) {
  const Mesh box = datasets::box_mesh({0.1, 0.4, 0.9}, {1, 1, 1}).value();
  const MassProperties p = properties(box, 10.0);
  const double mesh_rounding = 1e-6;
  EXPECT_NEAR(p.inertia_kg_m2[0], 10.0 / 12.0 * (0.16 + 0.81), mesh_rounding);
  EXPECT_NEAR(p.inertia_kg_m2[1], 10.0 / 12.0 * (0.01 + 0.81), mesh_rounding);
  EXPECT_NEAR(p.inertia_kg_m2[2], 10.0 / 12.0 * (0.01 + 0.16), mesh_rounding);
}

// Moved off the origin, the box is no primitive any more: the divergence theorem has to find the same.
TEST(MassProperties, TheDivergenceTheoremAgreesWithTheClosedFormAboutTheCenterOfMass) {
  Mesh moved = datasets::box_mesh({0.5, 1.0, 2.0}, {2, 3, 4}).value();
  for (core::Vec3& v : moved.vertices) v = v + core::Vec3{3.0F, -2.0F, 1.0F};
  const MassProperties p = properties(moved, 6.0);
  const double expected[] = {6.0 / 12.0 * 5.0, 6.0 / 12.0 * 4.25, 6.0 / 12.0 * 1.25, 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(p.inertia_kg_m2[k], expected[k], 1e-9) << k;
  EXPECT_NEAR(p.center_of_mass_m[0], 3.0, 1e-12);
  EXPECT_NEAR(p.center_of_mass_m[1], -2.0, 1e-12);
  EXPECT_NEAR(p.center_of_mass_m[2], 1.0, 1e-12);
}

TEST(MassProperties, SpheresAndCapsulesAreThoseThatTheirDrawingsApproach) {
  const MassProperties ball = properties(datasets::sphere_mesh(0.5, 8).value(), 2.0);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ball.inertia_kg_m2[k], 0.4 * 2.0 * 0.25, 1e-9);
  // The fine drawing of a capsule, moved so that it is no primitive, by the divergence theorem.
  Mesh drawing = datasets::capsule_mesh(0.5, 1.0, 64).value();
  const MassProperties exact = properties(drawing, 3.0);
  for (core::Vec3& v : drawing.vertices) v = v + core::Vec3{1.0F, 0.0F, 0.0F};
  const MassProperties drawn = properties(drawing, 3.0);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(drawn.inertia_kg_m2[k], exact.inertia_kg_m2[k], 2e-3 * exact.inertia_kg_m2[k]) << k;
}

TEST(MassProperties, ACylinderHasItsClosedFormAndItsDrawingNearlySo) {
  Mesh drawing = datasets::cylinder_mesh(0.5, 1.0, 256).value();
  const MassProperties exact = properties(drawing, 3.0);
  EXPECT_NEAR(exact.inertia_kg_m2[2], 3.0 * 0.25 / 2.0, 1e-9);
  EXPECT_NEAR(exact.inertia_kg_m2[0], 3.0 * (0.25 / 4.0 + 1.0 / 3.0), 1e-9);
  EXPECT_EQ(exact.inertia_kg_m2[0], exact.inertia_kg_m2[1]);
  for (core::Vec3& v : drawing.vertices) v = v + core::Vec3{1.0F, 0.0F, 0.0F};
  const MassProperties drawn = properties(drawing, 3.0);
  // A polygon of n corners has less area than its circle by 2/3 (pi / n)^2 of it, and its moments by twice that share.
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(drawn.inertia_kg_m2[k], exact.inertia_kg_m2[k], 2e-4 * exact.inertia_kg_m2[k]) << k;
}

// RIGID 2: a mesh that encloses no solid takes its convex hull's inertia, and the result says so.
TEST(MassProperties, AnOpenMeshTakesItsHullsAndSaysWhy) {
  const Mesh whole = datasets::box_mesh({0.5, 1.0, 2.0}, {2, 3, 4}).value();
  Mesh open = whole;
  open.triangles.pop_back();
  const auto made = core::uniform_solid(open, 6.0);
  ASSERT_TRUE(made.ok()) << made.error().line();
  EXPECT_EQ(made.value().solid, core::Solid::kHull);
  EXPECT_EQ(made.value().why_hull, "the mesh is open");
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(made.value().properties.inertia_kg_m2[k], properties(whole, 6.0).inertia_kg_m2[k], 1e-9) << k;
  EXPECT_EQ(core::uniform_solid(whole, 6.0).value().solid, core::Solid::kPrimitive);

  Mesh flat = whole;
  for (core::Vec3& v : flat.vertices) v.y = 0.0F;
  EXPECT_FALSE(core::uniform_solid(flat, 6.0).ok());
}

TEST(MassProperties, AMeshThatCrossesItselfTakesItsHulls) {
  // Two closed boxes, one pushed into the other: each point of their overlap is enclosed twice.
  Mesh crossing = datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value();
  const auto n = static_cast<std::uint32_t>(crossing.vertices.size());
  for (std::uint32_t v = 0; v < n; ++v) crossing.vertices.push_back(crossing.vertices[v] + core::Vec3{0.5F, 0, 0});
  const std::size_t triangles = crossing.triangles.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    const core::Triangle& from = crossing.triangles[t];
    crossing.triangles.push_back({from[0] + n, from[1] + n, from[2] + n});
  }
  const auto made = core::uniform_solid(crossing, 6.0);
  ASSERT_TRUE(made.ok()) << made.error().line();
  EXPECT_EQ(made.value().why_hull, "the mesh crosses itself");
  EXPECT_NEAR(made.value().properties.inertia_kg_m2[0], 6.0 / 12.0 * 2.0, 1e-9);
  EXPECT_NEAR(made.value().properties.inertia_kg_m2[1], 6.0 / 12.0 * (1.5 * 1.5 + 1.0), 1e-9);
  EXPECT_NEAR(made.value().properties.center_of_mass_m[0], 0.25, 1e-12);
  for (std::uint32_t v = n; v < 2 * n; ++v) crossing.vertices[v].x += 2.0F;
  EXPECT_EQ(core::uniform_solid(crossing, 6.0).value().solid, core::Solid::kMesh) << "two boxes apart";
}

TEST(MassProperties, PrincipalMomentsAreThoseOfTheTurnedMatrix) {
  // diag(1, 2, 2.5) turned by 30 degrees about z.
  const double c = std::sqrt(0.75);
  const double s = 0.5;
  const auto m = core::principal_moments({c * c + 2 * s * s, s * s + 2 * c * c, 2.5, (1.0 - 2.0) * s * c, 0, 0});
  EXPECT_NEAR(m[0], 1.0, 1e-12);
  EXPECT_NEAR(m[1], 2.0, 1e-12);
  EXPECT_NEAR(m[2], 2.5, 1e-12);
}

TEST(MassProperties, WhatNoBodyCanHaveIsRefused) {
  const auto refused = [](std::array<double, 6> inertia) {
    return !core::check_mass_properties({{0, 0, 0}, inertia}).ok();
  };
  EXPECT_FALSE(refused({1, 1, 1, 0, 0, 0}));
  EXPECT_FALSE(refused({1, 1, 2, 0, 0, 0})) << "a flat plate: the sum exactly";
  EXPECT_TRUE(refused({1, 1, 2.001, 0, 0, 0})) << "the triangle inequality";
  EXPECT_TRUE(refused({1, 1, 0, 0, 0, 0}));
  EXPECT_TRUE(refused({1, 1, -1, 0, 0, 0}));
  EXPECT_TRUE(refused({1, 1, 1, 2, 0, 0})) << "not positive, although its diagonal is";
  EXPECT_TRUE(refused({std::nan(""), 1, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace broadside::tests
