// Sets that are hard on a search: each is hard in the way that its name says, and engines that share no code find the
// same pairs in it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/mesh_boxes.hpp"
#include "datasets/box_streams/sheet_boxes.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::Box;
using Boxes = std::vector<Box>;

Boxes hard_boxes(const std::string& spec) {
  auto stream = datasets::make_box_stream(spec);
  EXPECT_TRUE(stream.ok()) << stream.error().line();
  return stream.ok() ? std::move(stream).value().boxes : Boxes{};
}

std::vector<core::Pair> pairs_by(const core::EngineRow& row, const Boxes& boxes) {
  auto settings = core::Settings::parse(row.id, row.settings, {});
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok());
  core::BroadPhase& broad = *engine.value().broad_phase;
  const std::vector<std::uint8_t> is_static(boxes.size());
  EXPECT_TRUE(broad.load(boxes, is_static).ok());
  EXPECT_TRUE(broad.find().ok());
  auto found = broad.read_back();
  EXPECT_TRUE(found.ok());
  return found.ok() ? found.value().pairs : std::vector<core::Pair>{};
}

// The number of pairs, where both engines agree on which they are.
std::size_t agreed_pairs(const Boxes& boxes) {
  const auto by_tree = pairs_by(reference::octree_cpu_row(), boxes);
  const auto by_trying_all = pairs_by(reference::all_pairs_row(), boxes);
  EXPECT_EQ(core::pair_digest(by_tree), core::pair_digest(by_trying_all));
  EXPECT_EQ(by_tree.size(), by_trying_all.size());
  return by_trying_all.size();
}

double side_of(const Box& b, int axis) {
  return double{b.max[axis]} - double{b.min[axis]};
}

TEST(HardBoxes, TwoEnginesFindTheSamePairs) {
  for (const char* spec : {"boxes:slivers:9000", "boxes:needles:9000", "boxes:spiral:9000", "boxes:cantor:9000",
                           "boxes:exponents:9000", "boxes:sheet:9000", "boxes:mesh:sphere:7", "boxes:mesh:cube"}) {
    SCOPED_TRACE(spec);
    EXPECT_GT(agreed_pairs(hard_boxes(spec)), 0U);
  }
}

// Frames of a fold: from flat to folded, each exact.
TEST(HardBoxes, TwoEnginesFindTheSamePairsAsASheetFolds) {
  datasets::BoxStream stream = datasets::sheet_boxes(3000, 4);
  std::size_t first = 0;
  for (std::uint32_t frame = 0; frame < stream.frames; ++frame) {
    if (frame > 0) {
      ASSERT_TRUE(stream.advance(stream.boxes).ok());
    }
    const std::size_t pairs = agreed_pairs(stream.boxes);
    if (frame == 0) first = pairs;
    // Of the flat cloth's triangles, each meets some 12 by a vertex that they share.
    EXPECT_GT(pairs, 3000U * 12U / 2U - 3000U) << frame;
    if (frame == 3) {
      EXPECT_GT(pairs, first + first / 4) << "folded layers meet";
    }
  }
}

TEST(NeedleBoxes, MeetAsOftenAsTheirFormulaSays) {
  constexpr double kCount = 20'000;
  const Boxes boxes = datasets::needle_boxes(20'000, 3);
  int along[3] = {};
  for (const Box& b : boxes) {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (side_of(b, axis) > side_of(b, longest)) longest = axis;
    ++along[longest];
    // Near 150 m a float's step is 2^-16 m; a side is the difference of two rounded numbers.
    EXPECT_NEAR(side_of(b, longest), 100.0, 0x1p-16);
    EXPECT_NEAR(side_of(b, (longest + 1) % 3), 1e-4, 0x1p-16);
  }
  for (const int count : along) EXPECT_NEAR(count, kCount / 3.0, 10.0 * std::sqrt(kCount / 3.0));
  // Different axes: 2 of 3 pairs. Half a needle's length is half the cube: within it with probability 3/4, on two axes;
  // on the third, within 1e-4 of 100. What rounding adds to a thickness of 1e-4 is up to a tenth of it.
  const double expected = 0.5 * kCount * kCount * (2.0 / 3.0) * 0.75 * 0.75 * 2e-6;
  EXPECT_NEAR(static_cast<double>(pairs_by(reference::octree_cpu_row(), boxes).size()), expected,
              0.1 * expected + 5.0 * std::sqrt(expected));
}

TEST(SliverBoxes, AreAThousandTimesLongerThanThickAndMeetEightOthers) {
  const Boxes boxes = datasets::sliver_boxes(20'000, 3);
  for (const Box& b : boxes) {
    double longest = 0.0;
    double thinnest = 10.0;
    for (int axis = 0; axis < 3; ++axis) {
      longest = std::max(longest, side_of(b, axis));
      thinnest = std::min(thinnest, side_of(b, axis));
    }
    // Places are below 4, where a float's step is 2^-22: a side of 5e-4 has an error of up to a thousandth.
    EXPECT_NEAR(longest / thinnest, 1000.0, 2.0);
  }
  // The cube is 1.5 lengths wide, so boxes reach out of it and a third of the overlaps is lost at its walls.
  const double a_box = 2.0 * static_cast<double>(pairs_by(reference::octree_cpu_row(), boxes).size()) / 20'000.0;
  EXPECT_GT(a_box, 4.0);
  EXPECT_LT(a_box, 8.5);
}

TEST(SpiralBoxes, OverlapAlongTheCurve) {
  // Each overlaps at least the next one.
  EXPECT_GT(agreed_pairs(datasets::spiral_boxes(5000, 1)), 4990U);
}

TEST(CantorBoxes, LeaveOutTheMiddleThirds) {
  const Boxes boxes = datasets::cantor_boxes(4096, 1);  // 8^4: four digits, so the world is 81 wide
  for (const Box& b : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      const double center = 0.5 * (double{b.min[axis]} + double{b.max[axis]});
      EXPECT_TRUE(center < 27.01 || center > 53.99) << center;
      EXPECT_LT(center, 81.01);
    }
}

TEST(ExponentBoxes, AreOfEveryScale) {
  std::set<int> places;
  std::set<int> sizes;
  for (const Box& b : datasets::exponent_boxes(20'000, 1)) {
    places.insert(std::ilogb(b.max.x));
    if (side_of(b, 0) > 0.0) sizes.insert(std::ilogb(side_of(b, 0)));
  }
  // Scales from 2^-140 to 2^124; smaller places and sizes are rounded to a few subnormal numbers.
  EXPECT_GT(places.size(), 260U);
  EXPECT_GT(sizes.size(), 250U);
}

TEST(MeshBoxes, AreTheTrianglesOfEachCopy) {
  const auto mesh = datasets::acquire_mesh("cube", {});
  ASSERT_TRUE(mesh.ok());
  const std::size_t triangles = mesh.value().triangles.size();
  const Boxes one = datasets::mesh_boxes(mesh.value(), 1, 1);
  ASSERT_EQ(one.size(), triangles);
  for (std::size_t k = 0; k < triangles; ++k)
    for (const std::uint32_t corner : mesh.value().triangles[k])
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(one[k].min[axis], mesh.value().vertices[corner][axis]);
        EXPECT_GE(one[k].max[axis], mesh.value().vertices[corner][axis]);
      }
  const Boxes three = datasets::mesh_boxes(mesh.value(), 3, 1);
  ASSERT_EQ(three.size(), 3 * triangles);
  // A turn keeps shared vertices: the triangles around a vertex still touch there.
  EXPECT_GE(agreed_pairs(three), 3 * agreed_pairs(one) / 2);
}

TEST(MeshBoxes, EachBadNameIsOneClearLine) {
  const auto line = [](const char* spec) {
    const auto stream = datasets::make_box_stream(spec);
    EXPECT_FALSE(stream.ok()) << spec;
    return stream.ok() ? std::string() : stream.error().line();
  };
  EXPECT_NE(line("boxes:mesh:cub").find("did you mean 'cube'"), std::string::npos) << line("boxes:mesh:cub");
  EXPECT_NE(line("boxes:mesh:cube:0").find("number of copies"), std::string::npos);
  EXPECT_NE(line("boxes:mesh:cube:x").find("number of copies"), std::string::npos);
  EXPECT_NE(line("boxes:mesh:cube:4000000").find("fewer copies"), std::string::npos);
}

}  // namespace
}  // namespace broadside
