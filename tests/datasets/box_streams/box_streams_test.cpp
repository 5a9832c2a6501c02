#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/box_sweeps.hpp"
#include "datasets/box_streams/raw_boxes.hpp"
#include "datasets/cube_root.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::Box;
using datasets::make_box_stream;
using tests::TemporaryFolder;

std::vector<Box> boxes_of(const std::string& spec) {
  auto stream = make_box_stream(spec);
  EXPECT_TRUE(stream.ok()) << stream.error().line();
  return stream.ok() ? std::move(stream).value().boxes : std::vector<Box>{};
}

void expect_sound(const std::vector<Box>& boxes) {
  for (const Box& b : boxes)
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(std::isfinite(b.min[k]) && std::isfinite(b.max[k]));
      ASSERT_LE(b.min[k], b.max[k]);
    }
}

double side(const Box& b, int axis) {
  return double{b.max[axis]} - double{b.min[axis]};
}

// By a sweep over x.
std::uint64_t overlap_count(std::vector<Box> boxes) {
  std::sort(boxes.begin(), boxes.end(), [](const Box& p, const Box& q) { return p.min.x < q.min.x; });
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].min.x <= boxes[i].max.x; ++j)
      count += core::overlaps(boxes[i], boxes[j]) ? 1 : 0;
  return count;
}

TEST(CubeRoot, IsTheCubeRoot) {
  EXPECT_EQ(datasets::cube_root(0.0), 0.0);
  for (const double v : {1e-9, 0.5, 1.0, 8.0, 27.0, 520e6, 1e12})
    // Newton ends within a few roundings of the root.
    EXPECT_NEAR(datasets::cube_root(v) / std::cbrt(v), 1.0, 4.0 * std::numeric_limits<double>::epsilon()) << v;
}

double overlaps_a_box(const std::vector<Box>& boxes) {
  expect_sound(boxes);
  return 2.0 * static_cast<double>(overlap_count(boxes)) / static_cast<double>(boxes.size());
}

// 20,000 boxes lose some overlaps at the walls: within 15 %.
TEST(BoxSweeps, DensityIsOverlapsABoxOverEight) {
  for (const double density : {0.1, 1.0, 4.0})
    EXPECT_NEAR(overlaps_a_box(datasets::boxes_of_density(20000, 3, density)) / (8.0 * density), 1.0, 0.15) << density;
}

TEST(BoxSweeps, SizeRatioLeavesTheOverlapsABox) {
  for (const double ratio : {1.0, 4.0, 16.0}) {
    const std::vector<Box> boxes = datasets::boxes_of_size_ratio(20000, 3, ratio);
    EXPECT_NEAR(overlaps_a_box(boxes) / 8.0, 1.0, 0.25) << ratio;
    double largest = 0.0;
    for (const Box& box : boxes) largest = std::max(largest, side(box, 0));
    EXPECT_GT(largest, 0.7 * ratio);
    EXPECT_LE(largest, 1.2 * ratio + 1e-3);
  }
}

TEST(BoxSweeps, GapWidensTheWorldAndLeavesTheOverlapsABox) {
  for (const double gap : {2.0, 64.0}) {
    const std::vector<Box> boxes = datasets::boxes_of_gap(20000, 3, gap);
    EXPECT_NEAR(overlaps_a_box(boxes) / 8.0, 1.0, 0.2) << gap;
    double right = 0.0;
    for (const Box& box : boxes) right = std::max(right, double{box.max.x});
    EXPECT_NEAR(right, (3.0 * gap + 1.0) * std::cbrt(20000.0 / 16.0), 2.0);
  }
}

TEST(UniformBoxes, OverlapAsOftenAsTheirFormulaSays) {
  constexpr double kCount = 20000;
  const std::vector<Box> boxes = boxes_of("boxes:uniform:20000");
  ASSERT_EQ(boxes.size(), 20000U);
  expect_sound(boxes);
  for (const Box& b : boxes)
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(side(b, k), 0.4999);
      ASSERT_LE(side(b, k), 1.5001);
    }
  // Two centers, uniform in 0 to L, are within h with probability 2 h / L - h^2 / L^2. Here h is the mean of two sides:
  // E h = 1 and E h^2 = 1 + 1/24.
  const double width = std::cbrt(kCount);
  const double one_axis = 2.0 / width - (1.0 + 1.0 / 24.0) / (width * width);
  const double expected = 0.5 * kCount * (kCount - 1.0) * one_axis * one_axis * one_axis;
  // Pairs that share a box vary together: the variance is a few times that of independent pairs. Ten deviations.
  EXPECT_NEAR(static_cast<double>(overlap_count(boxes)), expected, 10.0 * std::sqrt(expected));
}

TEST(HeapBoxes, AreSixteenHeapsInTheCornerOfAWideWorld) {
  const std::vector<Box> boxes = boxes_of("boxes:heaps:16000");
  ASSERT_EQ(boxes.size(), 16000U);
  expect_sound(boxes);
  for (const Box& b : boxes)
    for (int k = 0; k < 3; ++k) {
      // Strays lie up to 10,000 away, where half an ulp is 2^-11; a side is the difference of two.
      ASSERT_GE(side(b, k), 0.84 - 0x1p-10);
      ASSERT_LE(side(b, k), 1.24 + 0x1p-10);
    }
  // 990 boxes a heap: cones of radius (3 * 990 / pi)^(1/3) = 9.8, centers four radii apart.
  const double radius = std::cbrt(3.0 * 990.0 / 3.14159265358979);
  std::vector<int> heaps(16);
  int strays = 0;
  double widest = 0.0;
  for (const Box& b : boxes) {
    const core::Vec3 c = core::center(b);
    widest = std::max({widest, double{c.x}, double{c.y}});
    const int column = static_cast<int>(c.x / (4.0 * radius));
    const int row = static_cast<int>(c.y / (4.0 * radius));
    const bool is_near =
        column < 4 && row < 4 &&
        std::hypot(c.x - 4.0 * radius * (column + 0.5), c.y - 4.0 * radius * (row + 0.5)) < radius + 1.0;
    if (is_near)
      ++heaps[row * 4 + column];
    else
      ++strays;
  }
  for (const int count : heaps) EXPECT_NEAR(count, 990, 3);  // a stray may fall on a heap
  EXPECT_NEAR(strays, 160, 3);
  EXPECT_GT(widest, 0.9 * 64.0 * 16.0 * radius);
  // Shuffled: neighbors in the list are rarely neighbors in space.
  int adjacent = 0;
  for (std::size_t n = 1; n < boxes.size(); ++n) adjacent += core::overlaps(boxes[n - 1], boxes[n]) ? 1 : 0;
  EXPECT_LT(adjacent, 100);
}

TEST(MixedBoxes, SizesFollowAParetoWithOneOfAThousand) {
  const std::vector<Box> boxes = boxes_of("boxes:mixed:40000");
  expect_sound(boxes);
  int above_ten = 0;
  double largest = 0.0;
  for (const Box& b : boxes) {
    const double mean = (side(b, 0) + side(b, 1) + side(b, 2)) / 3.0;
    above_ten += mean > 10.0 ? 1 : 0;
    largest = std::max(largest, mean);
  }
  EXPECT_GE(largest, 800.0);
  EXPECT_LE(largest, 1200.0);
  // P(s > t) = 1 / t^2, and the mean of three factors in 0.8 to 1.2 has mean square 1 + 0.16 / 12 / 3: 1 % of 40,000,
  // five deviations of sqrt(400).
  EXPECT_NEAR(above_ten, 402, 100);
}

TEST(MovingBoxes, MoveByOnePercentOfTheirSize) {
  auto stream = make_box_stream("boxes:moving:2000");
  ASSERT_TRUE(stream.ok());
  EXPECT_EQ(stream.value().frames, 100U);
  EXPECT_EQ(stream.value().boxes, boxes_of("boxes:uniform:2000"));
  std::vector<Box> boxes = stream.value().boxes;
  for (std::uint32_t frame = 1; frame < stream.value().frames; ++frame) {
    const std::vector<Box> before = boxes;
    ASSERT_TRUE(stream.value().advance(boxes).ok());
    expect_sound(boxes);
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      const core::Vec3 a = core::center(before[n]);
      const core::Vec3 b = core::center(boxes[n]);
      const double moved =
          std::sqrt((double{b.x} - a.x) * (double{b.x} - a.x) + (double{b.y} - a.y) * (double{b.y} - a.y) +
                    (double{b.z} - a.z) * (double{b.z} - a.z));
      const double size = (side(boxes[n], 0) + side(boxes[n], 1) + side(boxes[n], 2)) / 3.0;
      // Coordinates up to 16 are rounded to 2^-21, a few of them per center.
      ASSERT_NEAR(moved, 0.01 * size, 8.0 * 0x1p-21) << n;
    }
  }
}

TEST(TeleportingBoxes, ATenthJumpsEachFrame) {
  auto stream = make_box_stream("boxes:teleporting:5000");
  ASSERT_TRUE(stream.ok());
  std::vector<Box> boxes = stream.value().boxes;
  const std::vector<Box> before = boxes;
  ASSERT_TRUE(stream.value().advance(boxes).ok());
  int jumped = 0;
  for (std::size_t n = 0; n < boxes.size(); ++n)
    jumped += core::length(core::center(boxes[n]) - core::center(before[n])) > 0.02F ? 1 : 0;
  // 5000 draws at 0.1: 500, five deviations of sqrt(450).
  EXPECT_NEAR(jumped, 500, 5.0 * std::sqrt(450.0));
}

TEST(BoxStreams, AreSeededAndTakeAnyCount) {
  for (const auto& row : datasets::box_stream_table()) {
    if (!row.is_counted) continue;
    const std::string prefix(row.prefix());
    for (const int n : {0, 1, 2, 99, 100, 101, 1700}) {
      const auto boxes = boxes_of(prefix + std::to_string(n));
      EXPECT_EQ(boxes.size(), static_cast<std::size_t>(n)) << row.pattern;
      expect_sound(boxes);
    }
    EXPECT_EQ(make_box_stream(prefix + "500", 3).value().boxes, make_box_stream(prefix + "500", 3).value().boxes);
    EXPECT_EQ(make_box_stream(prefix + "500", 3).value().boxes != make_box_stream(prefix + "500", 4).value().boxes,
              row.is_seeded)
        << row.pattern;
  }
}

TEST(BoxStreams, EachBadNameIsOneClearLine) {
  const auto line = [](const char* spec) {
    const auto stream = make_box_stream(spec);
    EXPECT_FALSE(stream.ok()) << spec;
    return stream.ok() ? std::string() : stream.error().line();
  };
  EXPECT_NE(line("boxes:unifrm:1000").find("did you mean 'boxes:uniform:"), std::string::npos);
  EXPECT_NE(line("boxes:uniform:-1").find("whole number"), std::string::npos);
  EXPECT_NE(line("boxes:uniform:1000000001").find("whole number from 0 to 1000000000"), std::string::npos);
  EXPECT_NE(line("boxes:identical:30001").find("whole number from 0 to 30000"), std::string::npos);
  EXPECT_NE(line("broadmark-freefall:cube:100").find("did you mean 'broadmark-freefall:cubes:"), std::string::npos);
  EXPECT_NE(line("boxes:needles").find("it has no number; give 'boxes:needles:"), std::string::npos);
  EXPECT_NE(line("absent.boxes").find("no such box file"), std::string::npos);
}

TEST(RawBoxes, ComeBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  const auto boxes = boxes_of("boxes:heaps:1000");
  const auto path = folder.path() / "b.boxes";
  ASSERT_TRUE(datasets::write_raw_boxes(boxes, path).ok());
  EXPECT_EQ(std::filesystem::file_size(path), 4U + 24U * 1000U);
  EXPECT_EQ(boxes_of(path.string()), boxes);
  ASSERT_TRUE(datasets::write_raw_boxes({}, path).ok());
  EXPECT_EQ(boxes_of(path.string()).size(), 0U);
}

TEST(RawBoxes, EachBadFileIsOneClearLine) {
  const TemporaryFolder folder;
  const auto line = [](const std::filesystem::path& path) {
    const auto boxes = datasets::read_raw_boxes(path);
    EXPECT_FALSE(boxes.ok()) << path;
    return boxes.ok() ? std::string() : boxes.error().line();
  };
  const auto with = [&](float bad_min, float bad_max) {
    std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
    boxes[1].min.y = bad_min;
    boxes[1].max.y = bad_max;
    const auto path = folder.path() / "bad.boxes";
    EXPECT_TRUE(datasets::write_raw_boxes(boxes, path).ok());
    return line(path);
  };
  constexpr float kInf = std::numeric_limits<float>::infinity();
  EXPECT_NE(with(0.0F, kInf).find("box 1: it is NaN or infinite on y"), std::string::npos);
  EXPECT_NE(with(std::nanf(""), 1.0F).find("box 1: it is NaN or infinite on y"), std::string::npos);
  EXPECT_NE(with(2.0F, 1.0F).find("box 1: its min is above its max on y"), std::string::npos);
  EXPECT_NE(line(folder.path() / "absent.boxes").find("no such box file"), std::string::npos);
  EXPECT_NE(line(folder.path()).find("not a file"), std::string::npos);
  EXPECT_NE(line(folder.file("short.boxes", "ab")).find("too few for a count"), std::string::npos);
  EXPECT_NE(line(folder.file("cut.boxes", std::string("\x02\x00\x00\x00", 4) + std::string(24, '\0'))).find("2 boxes"),
            std::string::npos);
  EXPECT_NE(line(folder.file("huge.boxes", std::string("\xff\xff\xff\xff", 4))).find("4294967295 boxes"),
            std::string::npos);
}

}  // namespace
}  // namespace broadside
