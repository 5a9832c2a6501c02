// Pairs that are kept between frames: each frame's are those of trying all, whatever moved; and counters show that
// searches were saved where boxes moved little, and that none were wasted where they jumped.
#include "reference/scene_octree/kept_pairs.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/sheet_boxes.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

using core::Box;
using core::Pair;

// Runs a stream and holds every frame against trying all.
void expect_every_frame(core::BroadPhase& broad, datasets::BoxStream& stream, std::uint32_t frames) {
  BoxCase c;
  c.is_static.resize(stream.boxes.size());
  for (std::size_t k = 0; k < c.is_static.size(); k += 6) c.is_static[k] = 1;
  ASSERT_TRUE(broad.load(stream.boxes, c.is_static).ok());
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    if (frame > 0) {
      ASSERT_TRUE(stream.advance(stream.boxes).ok());
    }
    ASSERT_TRUE(broad.update(stream.boxes).ok());
    ASSERT_TRUE(broad.find().ok());
    auto found = broad.read_back();
    ASSERT_TRUE(found.ok());
    c.boxes = stream.boxes;
    ASSERT_EQ(found.value().pairs, every_pair(c)) << "frame " << frame;
  }
}

// Boxes move by a hundredth of a side a frame and are fattened by a sixteenth, so the candidates of a search last for
// some six frames.
TEST(KeptPairs, SavesSearchesWhereBoxesMoveLittle) {
  datasets::BoxStream stream = datasets::moving_boxes(1500, 3, 40, 0.0);
  const auto broad = reference::make_kept_broad_phase(1);
  expect_every_frame(*broad, stream, 40);
  const auto counts = counts_of(*broad);
  EXPECT_EQ(counts.at("broad: frames searched") + counts.at("broad: frames of kept pairs"), 40U);
  EXPECT_GE(counts.at("broad: frames of kept pairs"), 5U * counts.at("broad: frames searched"));
}

TEST(KeptPairs, IsExactAndGivesUpWhereBoxesJump) {
  datasets::BoxStream stream = datasets::moving_boxes(1500, 3, 40, 0.1);
  const auto broad = reference::make_kept_broad_phase(1);
  expect_every_frame(*broad, stream, 40);
  const auto counts = counts_of(*broad);
  EXPECT_EQ(counts.at("broad: frames of kept pairs"), 0U);
  // Searches of fat boxes are tried in frames 0, 3, 8, 17, 34: after each failure the pause, in which boxes are
  // searched without fattening, is twice as long.
  const auto plain = reference::make_tree_broad_phase(1);
  datasets::BoxStream again = datasets::moving_boxes(1500, 3, 40, 0.1);
  expect_every_frame(*plain, again, 40);
  const std::uint64_t in_one_search = counts_of(*plain).at("broad: box tests") / 40U;
  EXPECT_LT(counts.at("broad: box tests"), (40U + 6U) * in_one_search);
}

TEST(KeptPairs, IsExactWhileASheetFolds) {
  datasets::BoxStream stream = datasets::sheet_boxes(1500, 200);
  const auto broad = reference::make_kept_broad_phase(1);
  expect_every_frame(*broad, stream, 30);
  EXPECT_GT(counts_of(*broad).at("broad: frames of kept pairs"), 0U);
}

// Boxes that grow, stand still, change places with others, turn into needles, and back.
TEST(KeptPairs, IsExactWhateverHappensBetweenFrames) {
  const auto broad = reference::make_kept_broad_phase(1);
  datasets::BoxStream stream;
  stream.boxes = datasets::uniform_boxes(5000, 1);
  stream.advance = [frame = 0](std::vector<Box>& boxes) mutable {
    switch (++frame % 7) {
      case 0:
        boxes = datasets::uniform_boxes(5000, 1);
        break;
      case 1:
      case 2:
        break;
      case 3:
        for (Box& b : boxes) b.max = b.max + core::Vec3{0.01F, 0.0F, 0.02F};
        break;
      case 4:
        std::swap(boxes[3], boxes[4]);
        break;
      case 5:
        boxes = datasets::needle_boxes(5000, 1);
        break;
      default:
        boxes[7] = Box{{1e30F, 1e30F, 1e30F}, {3e38F, 3e38F, 3e38F}};
        break;
    }
    return core::Status(core::Done{});
  };
  expect_every_frame(*broad, stream, 20);
}

TEST(KeptPairs, RefusesABoxThatIsNoneAfterGoodFrames) {
  const auto broad = reference::make_kept_broad_phase(1);
  std::vector<Box> boxes = datasets::uniform_boxes(500, 1);
  const std::vector<std::uint8_t> is_static(boxes.size());
  ASSERT_TRUE(broad->load(boxes, is_static).ok());
  ASSERT_TRUE(broad->find().ok());
  ASSERT_TRUE(broad->update(boxes).ok());
  boxes[17].min.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(broad->update(boxes).ok());
  boxes[17].min.y = boxes[17].max.y + 1e-3F;
  EXPECT_FALSE(broad->update(boxes).ok());
}

}  // namespace
}  // namespace broadside::tests
