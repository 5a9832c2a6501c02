// Parts of space: each pair is found in one part alone, and all parts together find what the whole set has.
#include "core/engine/space_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/degenerate_boxes.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"

namespace broadside::core {
namespace {

std::vector<Pair> every_pair(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (overlaps(boxes[i], boxes[j]) && (is_static[i] == 0 || is_static[j] == 0)) pairs.push_back({i, j});
  return pairs;
}

TEST(SpaceParts, FindTheWholeSetsPairsEachOnce) {
  const std::vector<Box> sets[] = {
      datasets::uniform_boxes(1200, 1),  datasets::mixed_boxes(1200, 1),     datasets::needle_boxes(600, 1),
      datasets::identical_boxes(60),     datasets::touching_boxes(1000),     datasets::flat_boxes(900, 1),
      datasets::exponent_boxes(1200, 1), datasets::subnormal_boxes(1000, 1), {},
      datasets::uniform_boxes(1, 1),
  };
  for (const std::vector<Box>& boxes : sets) {
    std::vector<std::uint8_t> is_static(boxes.size());
    for (std::size_t k = 0; k < boxes.size(); k += 4) is_static[k] = 1;
    const std::vector<Pair> whole = every_pair(boxes, is_static);
    for (const std::uint32_t parts : {1U, 2U, 3U, 8U, 50U}) {
      SCOPED_TRACE(testing::Message() << boxes.size() << " boxes, " << parts << " parts");
      const SpaceCut cut = cut_space(boxes, parts);
      EXPECT_EQ(cut.parts(), boxes.empty() ? 1U : parts);
      std::vector<Pair> all;
      for (std::uint32_t part = 0; part < cut.parts(); ++part) {
        const BoxPart own = part_of(cut, part, boxes, is_static);
        std::vector<Pair> pairs = every_pair(own.boxes, own.is_static);
        keep_own_pairs(cut, part, own, pairs);
        all.insert(all.end(), pairs.begin(), pairs.end());
      }
      EXPECT_EQ(pair_digest(all), pair_digest(whole));
      std::sort(all.begin(), all.end());
      EXPECT_EQ(all, whole) << "a pair twice, or none";
    }
  }
}

// A box is in all parts from the one where it begins to the one where it ends, also where several faces coincide and
// boxes end on them.
TEST(SpaceParts, ABoxReachesIntoThePartsFromItsBeginningToItsEnd) {
  const SpaceCut cut{0, {0.0F, 1.0F, 1.0F, 3.0F}};
  const float places[] = {-1.0F, 0.0F, 0.5F, 1.0F, 2.0F, 3.0F, 4.0F};
  for (const float low : places)
    for (const float high : places) {
      if (high < low) continue;
      SCOPED_TRACE(testing::Message() << low << " to " << high);
      const auto faces_up_to = [&](float x) {
        return std::count_if(cut.faces.begin(), cut.faces.end(), [x](float f) { return f <= x; });
      };
      for (std::uint32_t part = 0; part < cut.parts(); ++part)
        EXPECT_EQ(cut.reaches({{low, 0, 0}, {high, 1, 1}}, part),
                  faces_up_to(low) <= part && part <= faces_up_to(high));
    }
}

// Faces are placed so that as many boxes begin in each part; where boxes are small, few are in two parts.
TEST(SpaceParts, AreOfLikeSizeAndShareLittle) {
  const std::vector<Box> boxes = datasets::uniform_boxes(30'000, 1);
  const std::vector<std::uint8_t> is_static(boxes.size());
  const SpaceCut cut = cut_space(boxes, 8);
  std::size_t dealt = 0;
  for (std::uint32_t part = 0; part < 8; ++part) {
    const std::size_t count = part_of(cut, part, boxes, is_static).boxes.size();
    EXPECT_GT(count, 3700U);
    // 3,750 boxes begin there; of the part before, some 31 x 31 boxes, of length 1 on average, reach over the face.
    EXPECT_LT(count, 3751U + 1200U);
    dealt += count;
  }
  EXPECT_LT(dealt, 30'000U + 7U * 1200U);
}

// Plates across x: along x every box would reach over every face, along y and z hardly any box does.
TEST(SpaceParts, AreCutWhereFewBoxesReachOver) {
  std::vector<Box> boxes;
  for (int k = 0; k < 1000; ++k) {
    const auto y = static_cast<float>(k);
    boxes.push_back({{0.0F, y, 0.0F}, {100.0F, y + 0.5F, 100.0F}});
  }
  EXPECT_EQ(cut_space(boxes, 4).axis, 1);
}

}  // namespace
}  // namespace broadside::core
