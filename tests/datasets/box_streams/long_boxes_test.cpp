// The message about a set in which one box is far longer than the rest.
#include "datasets/box_streams/long_boxes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace broadside {
namespace {

using core::Box;
using datasets::long_boxes_remark;

Box box_of(float length) {
  return {{0, 0, 0}, {0.5F, length, 0.25F}};
}

TEST(LongBoxes, OneThatIsAMillionTimesLongerIsNamed) {
  std::vector<Box> boxes(1000, box_of(1.0F));
  EXPECT_EQ(long_boxes_remark(boxes), "");
  boxes[17] = box_of(1e6F);
  EXPECT_NE(long_boxes_remark(boxes).find("1 of 1000 boxes is up to 1e+06 times longer than the median"),
            std::string::npos)
      << long_boxes_remark(boxes);
  boxes[18] = box_of(2e4F);
  EXPECT_NE(long_boxes_remark(boxes).find("2 of 1000 boxes are up to 1e+06 times"), std::string::npos);
}

TEST(LongBoxes, SetsOfOneSizeOfPointsOrOfNothingAreNotRemarkedOn) {
  EXPECT_EQ(long_boxes_remark({}), "");
  EXPECT_EQ(long_boxes_remark(std::vector<Box>(5, box_of(1e6F))), "");
  EXPECT_EQ(long_boxes_remark(std::vector<Box>(5, Box{{1, 1, 1}, {1, 1, 1}})), "");
  EXPECT_EQ(long_boxes_remark(std::vector<Box>{box_of(1.0F), box_of(1.0F), box_of(9e3F)}), "");
}

}  // namespace
}  // namespace broadside
