// Inertia from meshes: closed forms, the divergence theorem against them, and what no body can have.
#include "core/scene/mass_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
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

TEST(MassProperties, AnOpenMeshHasNone) {
  Mesh open = datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value();
  open.triangles.pop_back();
  const auto made = core::uniform_mass_properties(open, 1.0);
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().line().find("not closed"), std::string::npos);
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
