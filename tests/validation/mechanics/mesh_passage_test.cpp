// Two meshes that are not convex move past each other within one step: which pairs the arbiter is asked about, and how
// deep they can have been.
#include "validation/mechanics/mesh_passage.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>

#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

// Cut into quarters, with a dent in its top.
std::shared_ptr<const core::Mesh> dented(std::array<double, 3> sides) {
  core::Mesh mesh = datasets::box_mesh(sides, {2, 2, 2}).value();
  for (core::Vec3& v : mesh.vertices)
    if (v.x == 0.0F && v.z == 0.0F && v.y > 0.0F) v.y *= 0.5F;
  return std::make_shared<const core::Mesh>(std::move(mesh));
}

struct Passed {
  double deepest_m = 0.0;
  std::uint64_t asked = 0;
};

// A cube of 1 m goes from one place to another, beside or through a plate of 4 m.
Passed passes(core::Vec3 from, core::Vec3 to) {
  bench::Specimen r = one_step(2);
  r.header.scene.gravity_m_s2 = {};
  r.header.scene.meshes = {dented({4, 0.2, 4}), dented({1, 1, 1})};
  r.header.scene.bodies[0].inverse_mass = 0.0F;
  r.header.scene.bodies[1].mesh = 1;
  r.header.scene.bodies[1].position = from;
  const core::Vec3 way = to - from;
  r.header.scene.bodies[1].velocity = (1.0F / static_cast<float>(kStep)) * way;
  end_step(r, [&](core::WideStates& s) { s.position[1] = {to.x, to.y, to.z}; });
  validation::MotionReader reader(r.header);
  const validation::Motion* motion = reader.read(r.frames[0], nullptr);
  EXPECT_NE(motion, nullptr);
  validation::MeshPassage meshes(r.header.scene);
  Passed passed;
  passed.deepest_m = meshes.deepest_m(*motion, {0, 1}, 0, static_cast<double>(core::length(way)));
  passed.asked = meshes.asked();
  return passed;
}

// Sixteen roundings of 2^-24 of some ten meters.
constexpr double kRounded = 1e-4;

TEST(MeshPassage, AsksNobodyWhereSweptBoxesAreApart) {
  // The cube's box is from x = 2.1 on, the plate's up to 2.
  const Passed beside = passes({2.6F, 3, 0}, {2.6F, -3, 0});
  EXPECT_EQ(beside.asked, 0U);
  EXPECT_LT(beside.deepest_m, kRounded);
}

TEST(MeshPassage, AsksTheArbiterWhereTheyMeet) {
  // Slantwise past the edge: the box around the cube's way meets the plate, the cube does not.
  const Passed past = passes({5.5F, 3, 0}, {2.0F, -3, 0});
  EXPECT_EQ(past.asked, 1U);
  EXPECT_LT(past.deepest_m, kRounded);
  // From 0.6 m above the middle to 0.6 m below: 1.2 of 6 m, at most half of it deep.
  const Passed through = passes({0, 3, 0}, {0, -3, 0});
  EXPECT_EQ(through.asked, 1U);
  EXPECT_GT(through.deepest_m, 0.5);
  EXPECT_LT(through.deepest_m, 0.7);
}

}  // namespace
}  // namespace broadside::tests
