// The memory of impulses: impulses are found again by their bodies; those of other pairs and of the step before the
// last are not.
#include "reference/octree_cpu/rigid/impulse_memory.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/contact.hpp"

namespace broadside::reference {
namespace {

core::ContactPatch patch(std::uint32_t a, std::uint32_t b) {
  core::ContactPatch p;
  p.a = a;
  p.b = b;
  return p;
}

TEST(ImpulseMemory, FindsThePointsOfAPair) {
  ImpulseMemory memory;
  EXPECT_TRUE(memory.of(1, 2).empty());
  const std::vector<core::ContactPatch> patches{patch(1, 2), patch(1, 2), patch(1, core::kFirstFace), patch(2, 5)};
  memory.begin(patches);
  memory.keep(1, 3, {7, 2.5F, {}});
  memory.keep(2, 0, {9, 1.5F, {}});
  ASSERT_EQ(memory.of(1, 2).size(), 8U);
  EXPECT_EQ(memory.of(1, 2)[7].feature, 7U);
  EXPECT_EQ(memory.of(1, 2)[7].normal_n, 2.5F);
  EXPECT_EQ(memory.of(1, core::kFirstFace)[0].feature, 9U);
  EXPECT_TRUE(memory.of(2, 3).empty());
  EXPECT_TRUE(memory.of(2, 1).empty());

  memory.begin(std::span(patches).first(1));
  EXPECT_TRUE(memory.of(1, core::kFirstFace).empty());
  EXPECT_EQ(memory.of(1, 2)[0].feature, 0U);
  memory.forget();
  EXPECT_TRUE(memory.of(1, 2).empty());
}

}  // namespace
}  // namespace broadside::reference
