// The tests that every broad-phase engine of the folder must pass: whatever it does inside, read_back must give exactly
// the pairs whose closed boxes overlap, P(6), save pairs of two static bodies. Every engine of the
// table is a subject; those with settings, or with defects of their library, have lines in subjects().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"
#include "tests/reference/boxes.hpp"
#include "tests/reference/subjects_of_the_table.hpp"

#if defined(__SANITIZE_ADDRESS__)
// FCL's tree-array and interval-tree managers leak (reference/README.md); leaks of our code are still reported.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfcl";
}
#endif

namespace broadside {
namespace {

using core::PairSet;

struct BroadPhaseSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings;
  // Empty, or the library's known defect (reference/README.md): it loses boxes that only touch, or that change size.
  std::string loses_touching = {};
  std::string breaks_on_resize = {};
  // The most boxes that this engine loads within seconds.
  std::size_t most_boxes = 100'000;
};

void PrintTo(const BroadPhaseSubject& subject, std::ostream* out) {
  *out << subject.name;
}

const std::vector<BroadPhaseSubject>& broad_phase_subjects() {
  static const std::vector<BroadPhaseSubject> all{
      {"all_pairs", reference::all_pairs_row, {}},
      {"all_pairs_1_thread", reference::all_pairs_row, {{"threads", "1"}}},
      {"octree_cpu", reference::octree_cpu_row, {}},
      {"octree_cpu_kept", reference::octree_cpu_row, {{"broad", "kept"}}},
      {"hash_cpu", reference::hash_cpu_row, {}},
      {"hash_cpu_small_cells", reference::hash_cpu_row, {{"cell_mm", "37"}}},
      {"hash_cpu_large_cells", reference::hash_cpu_row, {{"cell_mm", "3000"}}},
      {"bullet_dbvt", reference::bullet_dbvt_row, {}},
      {"bullet_dbvt_deferred", reference::bullet_dbvt_row, {{"deferred", "on"}}},
      {"bullet_dbvt_no_margin", reference::bullet_dbvt_row, {{"margin", "0"}}},
      {"bullet_dbvt_tree", reference::bullet_dbvt_tree_row, {}},
      {"bullet_dbvt_tree_margin", reference::bullet_dbvt_tree_row, {{"margin", "bullet"}}},
      // Each new box is carried past half of the others on three axes: 100,000 take more than five minutes.
      {.name = "bullet_sap", .row = reference::bullet_sap_row, .most_boxes = 20'000},
      {"embree_collide", reference::embree_collide_row, {}},
      {"embree_collide_1_thread_careful", reference::embree_collide_row, {{"threads", "1"}, {"quality", "high"}}},
      {"cgal_boxes", reference::cgal_boxes_row, {}},
      {"cgal_boxes_small_cutoff", reference::cgal_boxes_row, {{"cutoff", "3"}}},
      {"fcl_tree", reference::fcl_tree_row, {}},
      {"fcl_tree_array", reference::fcl_tree_row, {{"manager", "tree-array"}}},
      {"fcl_ssap", reference::fcl_sap_row, {}},
      {"fcl_sap",
       reference::fcl_sap_row,
       {{"manager", "sap"}},
       "FCL's SaP sorts the end of one box before the equal start of another",
       "FCL's SaP links an end point to itself when a box's two ends do not move the same way"},
      {"fcl_interval_tree",
       reference::fcl_sap_row,
       {{"manager", "interval-tree"}},
       "FCL's interval trees sort the end of one box before the equal start of another"},
      {"fcl_spatial_hash",
       reference::fcl_sap_row,
       {{"manager", "spatial-hash"}},
       "FCL's hash leaves out the cell that a box only touches"},
  };
  return all;
}

core::Engine broad_phase_engine(const BroadPhaseSubject& subject) {
  const core::EngineRow row = subject.row();
  auto settings = core::Settings::parse(row.id, row.settings, subject.settings);
  EXPECT_TRUE(settings.ok());
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

Box cube(float x, float y, float z, float side) {
  return {{x, y, z}, {x + side, y + side, z + side}};
}

std::vector<std::uint8_t> all_moving(std::size_t n) {
  return std::vector<std::uint8_t>(n, 0);
}

class BroadPhases : public testing::TestWithParam<BroadPhaseSubject> {
 protected:
  void load(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
    const auto status = phase().load(boxes, is_static);
    ASSERT_TRUE(status.ok()) << status.error().line();
  }

  PairSet find() {
    const auto found = phase().find();
    EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().line());
    auto set = phase().read_back();
    EXPECT_TRUE(set.ok());
    return set.ok() ? std::move(set).value() : PairSet{};
  }

  // What holds for every set of pairs, whatever the boxes are.
  static void expect_well_formed(const PairSet& set, std::size_t n) {
    EXPECT_TRUE(std::is_sorted(set.pairs.begin(), set.pairs.end()));
    EXPECT_EQ(std::adjacent_find(set.pairs.begin(), set.pairs.end()), set.pairs.end()) << "a pair twice";
    EXPECT_TRUE(std::all_of(set.pairs.begin(), set.pairs.end(), [&](Pair p) { return p.i < p.j && p.j < n; }));
    EXPECT_EQ(set.demanded, set.pairs.size());
    EXPECT_GE(set.raw, set.pairs.size());
    EXPECT_GE(set.filter_s, 0.0);
  }

  void expect_exact(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
    load(boxes, is_static);
    const PairSet set = find();
    expect_well_formed(set, boxes.size());
    EXPECT_EQ(set.pairs, brute_force(boxes, is_static));
  }
  void expect_exact(const std::vector<Box>& boxes) { expect_exact(boxes, all_moving(boxes.size())); }

  core::BroadPhase& phase() { return *engine_.broad_phase; }

  core::Engine engine_ = broad_phase_engine(GetParam());
};

// Load is not timed. Once, Bullet found all pairs in it, and a race of one frame charged nothing for them.
TEST_P(BroadPhases, LoadFindsNoPair) {
  std::mt19937 random(23);
  const std::vector<Box> boxes = random_boxes(random, 300, 2.0F, 0.6F);
  const std::vector<Pair> expected = brute_force(boxes, all_moving(boxes.size()));
  ASSERT_GT(expected.size(), 300U);
  load(boxes, all_moving(boxes.size()));
  const auto untimed = phase().read_back();
  ASSERT_TRUE(untimed.ok());
  EXPECT_EQ(untimed.value().raw, 0U);
  // The same set twice: both timed frames find all of it.
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_TRUE(phase().update(boxes).ok());
    EXPECT_EQ(find().pairs, expected) << "frame " << frame;
  }
}

TEST_P(BroadPhases, NamesItselfAndItsLibrary) {
  EXPECT_EQ(engine_.id, GetParam().row().id);
  EXPECT_NE(engine_.build.find_first_of("0123456789"), std::string::npos) << "no version in: " << engine_.build;
  EXPECT_EQ(engine_.build.find("unknown"), std::string::npos) << engine_.build;
}

TEST_P(BroadPhases, NoBodies) {
  load({}, {});
  EXPECT_TRUE(phase().update({}).ok());
  EXPECT_TRUE(find().pairs.empty());
}

TEST_P(BroadPhases, OneBodyHasNoPair) {
  const std::vector<Box> boxes{cube(0, 0, 0, 1)};
  load(boxes, all_moving(1));
  EXPECT_TRUE(phase().update(boxes).ok());
  EXPECT_TRUE(find().pairs.empty());
}

TEST_P(BroadPhases, TwoOverlappingAndOneFar) {
  load({cube(0, 0, 0, 1), cube(100, 0, 0, 1), cube(0.5F, 0.5F, 0.5F, 1)}, all_moving(3));
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 2}}));
}

TEST_P(BroadPhases, ContainedBoxOverlaps) {
  load({cube(1, 1, 1, 0.25F), cube(0, 0, 0, 10)}, all_moving(2));
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 1}}));
}

TEST_P(BroadPhases, FacesEdgesAndCornersThatTouchCount) {
  if (!GetParam().loses_touching.empty()) GTEST_SKIP() << GetParam().loses_touching;
  // 3 x 3 x 3 unit cubes on integer corners: each touches all of its up to 26 neighbors, exactly.
  std::vector<Box> boxes;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        boxes.push_back(cube(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 1));
  load(boxes, all_moving(boxes.size()));
  // Lattice neighbors: 7^3 ordered pairs with |dx|, |dy|, |dz| <= 1 (3 + 2 + 2 per axis), less 27 selves, by two.
  EXPECT_EQ(find().pairs.size(), (7U * 7U * 7U - 27U) / 2U);
  expect_exact(boxes);
}

TEST_P(BroadPhases, OneUlpApartIsApart) {
  const float beyond = std::nextafter(1.0F, 2.0F);
  load({cube(0, 0, 0, 1), {{beyond, 0, 0}, {2, 1, 1}}}, all_moving(2));
  EXPECT_TRUE(find().pairs.empty());
}

TEST_P(BroadPhases, IdenticalBoxesAllOverlap) {
  const std::vector<Box> boxes(20, cube(3, -2, 1, 0.5F));
  load(boxes, all_moving(boxes.size()));
  EXPECT_EQ(find().pairs.size(), 20U * 19U / 2U);
}

TEST_P(BroadPhases, PointsOverlapWhatContainsThem) {
  load({cube(0.5F, 0.5F, 0.5F, 0), cube(0, 0, 0, 1), cube(2, 2, 2, 0)}, all_moving(3));
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 1}}));
}

TEST_P(BroadPhases, TwoStaticBodiesAreNoPair) {
  load({cube(0, 0, 0, 1), cube(0.5F, 0, 0, 1), cube(0.25F, 0, 0, 1)}, {1, 1, 0});
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 2}, {1, 2}}));
}

TEST_P(BroadPhases, LineAndPlane) {
  std::vector<Box> line;
  std::vector<Box> plane;
  for (int k = 0; k < 100; ++k) line.push_back(cube(0.75F * static_cast<float>(k), 0, 0, 1));
  for (int k = 0; k < 144; ++k)
    plane.push_back(cube(0.75F * static_cast<float>(k % 12), 0, 0.75F * static_cast<float>(k / 12), 1));
  load(line, all_moving(line.size()));
  EXPECT_EQ(find().pairs.size(), 99U);  // each overlaps only the next one: 2 * 0.75 > 1
  load(plane, all_moving(plane.size()));
  EXPECT_EQ(find().pairs.size(), 2U * 12U * 11U + 2U * 11U * 11U);  // sides and diagonals of a 12 x 12 lattice
}

TEST_P(BroadPhases, CoordinatesOfAMillion) {
  // The spacing of floats at 1e6 is 1/16 m: boxes a spacing apart are apart, overlapping by one are not.
  const float ulp = 0.0625F;
  load({{{1e6F, -1e6F, 0}, {1e6F + 1, -1e6F + 1, 1}},
        {{1e6F + 1 + ulp, -1e6F, 0}, {1e6F + 2, -1e6F + 1, 1}},
        {{1e6F + 1 - ulp, -1e6F, 0}, {1e6F + 1, -1e6F + 1, 1}}},
       all_moving(3));
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 2}}));
}

TEST_P(BroadPhases, TwoThousandRandomBoxes) {
  std::mt19937 random(2000);
  // 2000 boxes of mean side 1 in a cube of side 16: about 2000^2 / 2 * (2 / 16)^3 = 3900 pairs.
  const std::vector<Box> boxes = random_boxes(random, 2000, 16.0F, 2.0F);
  std::vector<std::uint8_t> is_static(boxes.size());
  for (std::uint8_t& mark : is_static) mark = random() % 4 == 0 ? 1 : 0;
  expect_exact(boxes, is_static);
}

// A long flat world, so that the sweep along x is short. Of 5e9 pairs a share of 1.25 m / 6000 m overlap along x, and
// about 0.29 by 0.29 of these along the other two axes: some 80,000.
TEST_P(BroadPhases, HundredThousandBoxesSlow) {
  static const std::vector<Box> boxes = [] {
    std::mt19937 random(100000);
    std::uniform_real_distribution<float> along(0.0F, 6000.0F);
    std::uniform_real_distribution<float> across(0.0F, 4.0F);
    std::uniform_real_distribution<float> size(0.25F, 1.0F);
    std::vector<Box> made(100000);
    for (Box& b : made) {
      b.min = {along(random), across(random), across(random)};
      b.max = b.min + core::Vec3{size(random), size(random), size(random)};
    }
    return made;
  }();
  static const std::vector<Pair> expected = sweep(boxes);
  ASSERT_GT(expected.size(), 50000U);
  const std::size_t count = GetParam().most_boxes;
  const std::vector<Box> some(boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(count));
  load(some, all_moving(count));
  PairSet set = find();
  expect_well_formed(set, count);
  // Among so many boxes some touch by chance.
  std::vector<Pair> wanted = expected;
  std::erase_if(wanted, [&](const Pair& p) { return p.j >= count; });
  if (!GetParam().loses_touching.empty()) {
    const auto touches = [&](const Pair& p) { return only_touch(boxes[p.i], boxes[p.j]); };
    std::erase_if(set.pairs, touches);
    EXPECT_GT(std::erase_if(wanted, touches), 0U) << "nothing to lose: compare them all";
  }
  // If a set of this size were printed, the message would fill pages.
  EXPECT_EQ(set.pairs.size(), wanted.size());
  EXPECT_TRUE(set.pairs == wanted);
}

// Fifty frames of drifting boxes, some of which teleport and some of which change size, with an exact answer in each.
TEST_P(BroadPhases, MovingTeleportingAndResizingBoxes) {
  if (!GetParam().breaks_on_resize.empty()) GTEST_SKIP() << GetParam().breaks_on_resize;
  std::mt19937 random(50);
  std::vector<Box> boxes = random_boxes(random, 120, 6.0F, 1.5F);
  std::vector<std::uint8_t> is_static(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); i += 5) is_static[i] = 1;
  load(boxes, is_static);
  EXPECT_EQ(find().pairs, brute_force(boxes, is_static)) << "before the first update";
  std::uniform_real_distribution<float> step(-0.1F, 0.1F);
  for (int frame = 1; frame <= 50; ++frame) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (is_static[i] != 0) continue;
      if (random() % 20 == 0) {
        boxes[i] = random_boxes(random, 1, 6.0F, 1.5F)[0];
      } else {
        boxes[i] = core::translated(boxes[i], {step(random), step(random), step(random)});
      }
    }
    ASSERT_TRUE(phase().update(boxes).ok());
    const PairSet set = find();
    expect_well_formed(set, boxes.size());
    ASSERT_EQ(set.pairs, brute_force(boxes, is_static)) << "frame " << frame;
  }
}

// Some engines fix the bounds of their world at load.
TEST_P(BroadPhases, BoxesThatLeaveTheLoadedWorld) {
  std::vector<Box> boxes{cube(0, 0, 0, 1), cube(2, 2, 2, 1), cube(4, 0.5F, 0.5F, 1)};
  load(boxes, all_moving(3));
  EXPECT_TRUE(find().pairs.empty());
  boxes = {cube(500, -300, 0, 1), cube(500.5F, -300, 0.5F, 1), cube(-900, 0, 0, 1)};
  ASSERT_TRUE(phase().update(boxes).ok());
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 1}}));
  boxes = {cube(0, 0, 0, 1), cube(9, 9, 9, 1), cube(0.5F, 0.5F, 0.5F, 1)};
  ASSERT_TRUE(phase().update(boxes).ok());
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 2}}));
}

// Bodies that come to rest and start again: engines move such bodies between their structures.
TEST_P(BroadPhases, RestThenMoveAgain) {
  std::vector<Box> boxes{cube(0, 0, 0, 1), cube(5, 0, 0, 1), cube(10, 0, 0, 1)};
  load(boxes, all_moving(3));
  for (int frame = 0; frame < 5; ++frame) {
    ASSERT_TRUE(phase().update(boxes).ok());
    EXPECT_TRUE(find().pairs.empty());
  }
  boxes[0] = cube(4.5F, 0, 0, 1);
  ASSERT_TRUE(phase().update(boxes).ok());
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{0, 1}}));
  boxes = {cube(20, 0, 0, 1), cube(9.5F, 0, 0, 1), boxes[2]};
  ASSERT_TRUE(phase().update(boxes).ok());
  EXPECT_EQ(find().pairs, (std::vector<Pair>{{1, 2}}));
}

// Bullet's margin is one global of the library: an engine that changes it must restore it for the next one.
TEST_P(BroadPhases, TwoEnginesAtOnceDoNotDisturbEachOther) {
  core::Engine other = broad_phase_engine(broad_phase_subjects().front());
  core::Engine bullet = broad_phase_engine({"", reference::bullet_dbvt_row, {{"margin", "0"}}});
  const std::vector<Box> boxes{cube(0, 0, 0, 1), cube(0.5F, 0, 0, 1), cube(1.51F, 0, 0, 1)};
  const std::vector<Box> moved{cube(0, 0, 0, 1), cube(0.505F, 0, 0, 1), cube(1.51F, 0, 0, 1)};
  load(boxes, all_moving(3));
  for (core::Engine* e : {&other, &bullet}) ASSERT_TRUE(e->broad_phase->load(boxes, all_moving(3)).ok());
  const std::uint64_t raw_alone = [&] {
    core::Engine alone = broad_phase_engine(GetParam());
    EXPECT_TRUE(alone.broad_phase->load(boxes, all_moving(3)).ok());
    EXPECT_TRUE(alone.broad_phase->update(moved).ok());
    EXPECT_TRUE(alone.broad_phase->find().ok());
    return alone.broad_phase->read_back().value().raw;
  }();
  for (core::Engine* e : {&other, &bullet}) ASSERT_TRUE(e->broad_phase->update(moved).ok());
  ASSERT_TRUE(phase().update(moved).ok());
  const PairSet set = find();
  EXPECT_EQ(set.pairs, (std::vector<Pair>{{0, 1}}));
  EXPECT_EQ(set.raw, raw_alone);
}

TEST_P(BroadPhases, LoadStartsAfresh) {
  load(std::vector<Box>(4, cube(0, 0, 0, 1)), all_moving(4));
  EXPECT_EQ(find().pairs.size(), 6U);
  load({cube(0, 0, 0, 1), cube(7, 0, 0, 1)}, all_moving(2));
  EXPECT_TRUE(find().pairs.empty());
}

TEST_P(BroadPhases, BadBoxesAreRefusedByName) {
  const std::vector<Box> boxes{cube(0, 0, 0, 1), {{0, 0, 0}, {std::nanf(""), 1, 1}}};
  const auto status = phase().load(boxes, all_moving(2));
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("box 1"), std::string::npos) << status.error().line();
  EXPECT_FALSE(phase().load(boxes, all_moving(1)).ok());
  load({cube(0, 0, 0, 1)}, all_moving(1));
  EXPECT_FALSE(phase().update({}).ok()) << "fewer boxes than were loaded";
}

// Some engines are optional at build time: an absent engine has nothing to test.
std::vector<BroadPhaseSubject> subjects_that_are_built() {
  auto built = broad_phase_subjects();
  std::erase_if(built, [](const BroadPhaseSubject& s) {
    const auto absent = s.row().absent;
    return absent != nullptr && !absent().empty();
  });
  return built;
}

INSTANTIATE_TEST_SUITE_P(Reference, BroadPhases,
                         testing::ValuesIn(tests::with_unlisted(subjects_that_are_built(), "broad")),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside
