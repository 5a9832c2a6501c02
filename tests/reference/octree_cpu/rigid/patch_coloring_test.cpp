// The coloring of patches: patches of one color share no moved body, and the coloring is a function of the list.
#include "reference/octree_cpu/rigid/patch_coloring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "core/contact.hpp"

namespace broadside::reference {
namespace {

std::vector<core::RigidMass> moved(std::size_t count) {
  std::vector<core::RigidMass> masses(count);
  for (core::RigidMass& m : masses) m.inverse_mass = 1.0F;
  return masses;
}

core::ContactPatch patch_between(std::uint32_t a, std::uint32_t b) {
  core::ContactPatch p;
  p.a = a;
  p.b = b;
  return p;
}

void expect_proper(const PatchColoring& coloring, const std::vector<core::ContactPatch>& patches,
                   const std::vector<core::RigidMass>& masses) {
  std::set<std::uint32_t> all(coloring.order().begin(), coloring.order().end());
  ASSERT_EQ(all.size(), patches.size());
  ASSERT_EQ(coloring.order().size(), patches.size());
  for (std::uint32_t c = 0; c < coloring.color_count(); ++c) {
    std::set<std::uint32_t> seen;
    for (std::uint32_t k = coloring.color_begin()[c]; k < coloring.color_begin()[c + 1]; ++k)
      for (const std::uint32_t body : {patches[coloring.order()[k]].a, patches[coloring.order()[k]].b}) {
        const bool is_moved = !core::is_face(body) && masses[body].inverse_mass > 0.0F;
        EXPECT_TRUE(!is_moved || seen.insert(body).second) << "color " << c << " body " << body;
      }
  }
}

TEST(PatchColoring, RandomPatchesShareNoMovedBody) {
  std::mt19937 random(7);
  auto masses = moved(200);
  masses[3].inverse_mass = 0.0F;
  std::vector<core::ContactPatch> patches;
  for (int k = 0; k < 900; ++k) {
    const auto a = static_cast<std::uint32_t>(random() % 200);
    const auto b = static_cast<std::uint32_t>(random() % 200);
    if (a < b) patches.push_back(patch_between(a, b));
    if (k % 9 == 0) patches.push_back(patch_between(a, core::kFirstFace + 2));
  }
  PatchColoring coloring;
  coloring.color(patches, masses);
  expect_proper(coloring, patches, masses);
  // A static body connects no two patches.
  EXPECT_LT(coloring.color_count(), 40U);
}

TEST(PatchColoring, BodyOfManyPatchesHasThemInColorsOfTheirOwn) {
  const auto masses = moved(301);
  std::vector<core::ContactPatch> patches;
  for (std::uint32_t k = 1; k < 301; ++k) patches.push_back(patch_between(0, k));
  for (std::uint32_t k = 1; k < 300; ++k) patches.push_back(patch_between(k, k + 1));
  PatchColoring coloring;
  coloring.color(patches, masses);
  expect_proper(coloring, patches, masses);
  EXPECT_GE(coloring.color_count(), 300U);
}

TEST(PatchColoring, PatchesOfOnePairFollowEachOther) {
  const auto masses = moved(2);
  PatchColoring coloring;
  const std::vector<core::ContactPatch> patches{patch_between(0, 1), patch_between(0, 1), patch_between(0, 1)};
  coloring.color(patches, masses);
  EXPECT_EQ(coloring.color_count(), 3U);
  EXPECT_TRUE(std::is_sorted(coloring.order().begin(), coloring.order().end()));
}

}  // namespace
}  // namespace broadside::reference
