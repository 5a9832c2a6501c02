// broad=kept on the GPU, with the kernels' threads on the host: every frame's pairs are those of trying all, whatever
// moves, and counters show which frames were not searched.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "gpu/broad/kept_finder.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

tests::BoxCase uniform_case(std::uint32_t count) {
  tests::BoxCase c;
  c.boxes = datasets::uniform_boxes(count, 2);
  c.is_static.resize(count);
  for (std::size_t k = 0; k < count; k += 4) c.is_static[k] = 1;
  return c;
}

// By some thousandths of a box, each its own way.
void move_a_little(tests::BoxCase& c, int frame) {
  tests::Draw draw(static_cast<std::uint64_t>(frame) + 77);
  for (std::size_t k = 0; k < c.boxes.size(); ++k)
    if (c.is_static[k] == 0)
      c.boxes[k] = core::translated(
          c.boxes[k], {draw.between(-0.005F, 0.005F), draw.between(-0.005F, 0.005F), draw.between(-0.005F, 0.005F)});
}

void jump(tests::BoxCase& c, int frame) {
  tests::Draw draw(static_cast<std::uint64_t>(frame) + 7);
  for (Box& b : c.boxes) {
    const core::Vec3 side = b.max - b.min;
    b = tests::box_at({draw.between(0, 7), draw.between(0, 7), draw.between(0, 7)}, side);
  }
}

std::vector<Pair> pairs_of(KeptFinder& finder) {
  EXPECT_TRUE(finder.find().ok());
  auto set = finder.read_back();
  EXPECT_TRUE(set.ok());
  auto lying = finder.pairs_on_device();
  EXPECT_TRUE(lying.ok());
  std::vector<Pair> there(lying.value().data, lying.value().data + lying.value().count);
  std::sort(there.begin(), there.end());
  EXPECT_EQ(there, set.value().pairs);
  return std::move(set.value().pairs);
}

core::DeviceBoxes kept_on_device(const std::vector<Box>& boxes) {
  return {reinterpret_cast<const float*>(boxes.data()), boxes.size()};
}

TEST(KeptOnHost, FramesOfSmallMotionAreNotSearched) {
  for (const bool is_on_device : {false, true}) {
    tests::BoxCase c = uniform_case(350);
    KeptFinder finder({});
    ASSERT_TRUE(
        (is_on_device ? finder.load_on_device(kept_on_device(c.boxes), c.is_static) : finder.load(c.boxes, c.is_static))
            .ok());
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
    for (int frame = 0; frame < 6; ++frame) {
      move_a_little(c, frame);
      ASSERT_TRUE((is_on_device ? finder.update_on_device(kept_on_device(c.boxes)) : finder.update(c.boxes)).ok());
      EXPECT_EQ(pairs_of(finder), tests::every_pair(c)) << "frame " << frame;
    }
    // A box is fattened by a sixteenth of its mean side, at least 0.03, and moves 0.03 at most.
    auto counts = tests::counts_of(finder);
    EXPECT_EQ(counts["broad: frames searched"], 1U);
    EXPECT_EQ(counts["broad: frames of kept pairs"], 6U);
    EXPECT_GT(counts["broad: candidates tested"], 7 * tests::every_pair(c).size());
    EXPECT_EQ(finder.path(), "1 frames searched, 6 from pairs that were kept");
  }
}

// In some frames every box jumps, in others all rest. After searches whose pairs served no further frame, boxes are
// searched without fattening.
TEST(KeptOnHost, IsExactWhereEverythingJumps) {
  tests::BoxCase c = uniform_case(300);
  KeptFinder finder({});
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  for (int frame = 0; frame < 24; ++frame) {
    if (frame < 8 || frame % 9 == 0) jump(c, frame);
    ASSERT_TRUE(finder.update(c.boxes).ok());
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c)) << "frame " << frame;
  }
  auto counts = tests::counts_of(finder);
  EXPECT_EQ(counts["broad: frames searched"] + counts["broad: frames of kept pairs"], 25U);
  EXPECT_GT(counts["broad: frames of kept pairs"], 3U);
}

// One box that is slightly outside of its fat box, on any side, causes a search.
TEST(KeptOnHost, OneBoxThatLeavesMakesASearch) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float by : {-0.2F, 0.2F}) {
      tests::BoxCase c = uniform_case(100);
      KeptFinder finder({});
      ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
      EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
      core::Vec3 step{0, 0, 0};
      step[axis] = by;
      c.boxes[57] = core::translated(c.boxes[57], step);
      ASSERT_TRUE(finder.update(c.boxes).ok());
      EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
      EXPECT_EQ(tests::counts_of(finder)["broad: frames searched"], 2U);
    }
  }
}

TEST(KeptOnHost, EveryFamilyWhileItRests) {
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 110, 9);
    KeptFinder finder({});
    ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
    for (int frame = 0; frame < 2; ++frame) {
      EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
      ASSERT_TRUE(finder.update(c.boxes).ok());
    }
  }
}

TEST(KeptOnHost, FewBoxesAndWhatIsNoBox) {
  KeptFinder finder({});
  for (const std::uint32_t count : {0U, 1U, 2U}) {
    const tests::BoxCase c = uniform_case(count);
    ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  }
  tests::BoxCase c = uniform_case(60);
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  std::vector<Box> bad = c.boxes;
  std::swap(bad[31].min.y, bad[31].max.y);
  EXPECT_NE(finder.update(bad).error().line().find("box 31"), std::string::npos);
  EXPECT_NE(finder.update_on_device(kept_on_device(bad)).error().line().find("box 31"), std::string::npos);
  bad.pop_back();
  EXPECT_NE(finder.update(bad).error().line().find("59 boxes after a load of 60"), std::string::npos);
  ASSERT_TRUE(finder.update(c.boxes).ok());
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
}

}  // namespace
}  // namespace broadside::gpu
