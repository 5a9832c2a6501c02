// The tests that every narrow-phase engine of the folder must pass, on bodies whose distance is known in closed form.
// Poses stay out of the touching band: at a gap of zero no sign is required.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/reference/narrow_phases.hpp"

namespace broadside {
namespace {

TEST_P(NarrowPhases, NamesItselfAndItsLibrary) {
  EXPECT_EQ(engine_.id, GetParam().row().id);
  EXPECT_EQ(engine_.build.find("unknown"), std::string::npos) << engine_.build;
}

TEST_P(NarrowPhases, FaceToFace) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  const Separation s = measure({cube, cube}, {{{0, 0, 0}, {}}, {{1.25F, 0.125F, -0.25F}, {}}});
  expect_apart(s, 0.25);
  if (!GetParam().tells_distance) return;
  EXPECT_NEAR(s.normal.x, -1.0, 1e-6) << "from B, on the right, to A";
  EXPECT_NEAR(s.witness_a.x, 0.5, 1e-6);
  EXPECT_NEAR(s.witness_b.x, 0.75, 1e-6);
}

TEST_P(NarrowPhases, SwappedRolesTurnTheNormal) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  const Separation s = measure({cube, cube}, {{{1.25F, 0.125F, -0.25F}, {}}, {{0, 0, 0}, {}}});
  expect_apart(s, 0.25);
  if (!GetParam().tells_distance) return;
  EXPECT_NEAR(s.normal.x, 1.0, 1e-6) << "from B, on the left, to A";
}

TEST_P(NarrowPhases, CornerToCorner) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 2);
  const Separation s = measure({cube, cube}, {{{0, 0, 0}, {}}, {{1.25F, 1.25F, 1.25F}, {}}});
  expect_apart(s, 0.25 * std::sqrt(3.0));
}

TEST_P(NarrowPhases, EdgeToCrossedEdge) {
  // Turned by 45 degrees about z, B shows an edge along z to A's edge; A is turned about y, so the edges cross.
  const float s45 = std::sqrt(0.5F);
  const float c = std::cos(0.39269908F);
  const float s = std::sin(0.39269908F);
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  if (GetParam().is_boxes) GTEST_SKIP() << "takes bodies for their axis-aligned boxes, which meet here";
  const Separation found =
      measure({cube, cube}, {{{0, 0, 0}, {c, 0, s, 0}}, {{2.0F * s45 + 0.25F, 0, 0}, {c, 0, 0, s}}});
  expect_apart(found, 0.25);
}

TEST_P(NarrowPhases, SpheresAlongAnAxis) {
  // Both meshes lie in their unit balls, and have a vertex where the balls are nearest to each other.
  const core::Mesh sphere = sphere_mesh(3);
  const Separation s = measure({sphere, sphere}, {{{0, 0, 0}, {}}, {{0, 2.5F, 0}, {}}});
  expect_apart(s, 0.5);
  if (!GetParam().tells_distance) return;
  EXPECT_NEAR(s.normal.y, -1.0, 1e-6);
}

TEST_P(NarrowPhases, DifferentMeshes) {
  const Separation s = measure({box_mesh({0.25F, 1, 0.5F}, 3), sphere_mesh(2)}, {{{-1, 0, 0}, {}}, {{2, 0, 0}, {}}});
  expect_apart(s, 3.0 - 0.25 - 1.0);
}

TEST_P(NarrowPhases, OverlapIsTouching) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  const Separation s = measure({cube, cube}, {{{0, 0, 0}, {}}, {{0.75F, 0.125F, 0.25F}, {}}});
  EXPECT_TRUE(s.is_touching);
  EXPECT_LE(s.distance_m, 0.0);
}

// Boxes with parallel axes: the depth is the least overlap of the three axes, along that axis, from B to A.
TEST_P(NarrowPhases, DepthIsTheLeastOverlapOfParallelBoxes) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  const float s45 = std::sqrt(0.5F);
  const core::Quat quarter{s45, 0, 0, s45};  // turned by 90 degrees a cube is itself
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      Vec3 offset{0.0625F, -0.125F, 0.09375F};
      offset[axis] = side * 0.875F;
      const Separation s = measure({cube, cube}, {{{3, 2, 1}, {}}, {Vec3{3, 2, 1} + offset, quarter}});
      EXPECT_TRUE(s.is_touching);
      if (!GetParam().tells_depth) {
        EXPECT_LE(s.distance_m, 0.0);
        EXPECT_EQ(s.normal, Vec3{}) << "no depth, no direction";
        continue;
      }
      EXPECT_NEAR(s.distance_m, -0.125, tolerance());
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.normal[k], k == axis ? -side : 0.0F, 1e-4) << "axis " << axis;
    }
  }
}

TEST_P(NarrowPhases, InsideWithoutMeetingSurfaces) {
  const Separation s =
      measure({box_mesh({0.25F, 0.25F, 0.25F}, 1), box_mesh({1, 1, 1}, 1)}, {{{0.25F, 0, 0}, {}}, {{0, 0, 0}, {}}});
  if (GetParam().is_solid) {
    EXPECT_TRUE(s.is_touching);
    EXPECT_LE(s.distance_m, 0.0);
  } else {
    EXPECT_FALSE(s.is_touching);
    EXPECT_NEAR(s.distance_m, 0.5, tolerance());
  }
}

// Boxes with parallel axes: the distance is the length of the gaps on the three axes.
TEST_P(NarrowPhases, RandomBoxesWithParallelAxes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> half(0.1F, 0.6F);
  std::uniform_real_distribution<float> at(-1.5F, 1.5F);
  std::vector<core::Mesh> meshes;
  std::vector<Vec3> halves;
  std::vector<Pose> poses;
  for (int k = 0; k < 40; ++k) {
    halves.push_back({half(random), half(random), half(random)});
    meshes.push_back(box_mesh(halves.back(), 1 + k % 3));
    poses.push_back({{at(random), at(random), at(random)}, {}});
  }
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i < 40; ++i)
    for (std::uint32_t j = i + 1; j < 40; ++j) pairs.push_back({i, j});
  const core::Scene scene = scene_of(std::move(meshes));
  ASSERT_TRUE(phase().load(scene).ok());
  ASSERT_TRUE(phase().measure(pairs, poses).ok());
  const auto found = phase().read_back();
  ASSERT_TRUE(found.ok());
  ASSERT_EQ(found.value().size(), pairs.size());
  int apart = 0;
  int overlapping = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    double squared = 0.0;
    double least_overlap = 1e9;
    bool is_nested = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = std::abs(static_cast<double>(poses[i].position[axis]) - poses[j].position[axis]) -
                         halves[i][axis] - halves[j][axis];
      squared += gap > 0.0 ? gap * gap : 0.0;
      least_overlap = std::min(least_overlap, -gap);
      const double offset = std::abs(static_cast<double>(poses[i].position[axis]) - poses[j].position[axis]);
      is_nested = is_nested && offset <= std::abs(static_cast<double>(halves[i][axis]) - halves[j][axis]);
    }
    const Separation& s = found.value()[k];
    // Poses within 1e-4 m of touching are not judged.
    if (squared > 1e-8) {
      ++apart;
      if (GetParam().tells_distance) {
        EXPECT_NEAR(s.distance_m, std::sqrt(squared), tolerance()) << i << ' ' << j;
      }
      EXPECT_FALSE(s.is_touching) << i << ' ' << j;
    } else if (least_overlap > 1e-4 && !is_nested) {
      ++overlapping;
      EXPECT_TRUE(s.is_touching) << i << ' ' << j;
      EXPECT_LE(s.distance_m, 0.0) << i << ' ' << j;
      if (GetParam().tells_depth) {
        EXPECT_LE(s.distance_m, -least_overlap + tolerance()) << i << ' ' << j;
        const double least = GetParam().depth_is_least ? -least_overlap : -10.0;
        EXPECT_GE(s.distance_m, least - tolerance()) << i << ' ' << j;
      }
    }
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(overlapping, 50);
}

TEST_P(NarrowPhases, SameAnswersAgainAndOnAnyNumberOfThreads) {
  const core::Scene scene = scene_of(std::vector<core::Mesh>(8, sphere_mesh(1)));
  std::mt19937 random(11);
  std::uniform_real_distribution<float> at(-3.0F, 3.0F);
  std::vector<Pose> poses;
  for (int k = 0; k < 8; ++k) poses.push_back({{at(random), at(random), at(random)}, {}});
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::uint32_t j = i + 1; j < 8; ++j) pairs.push_back({i, j});
  const auto answers = [&](core::NarrowPhase& engine) {
    EXPECT_TRUE(engine.load(scene).ok());
    EXPECT_TRUE(engine.measure(pairs, poses).ok());
    return engine.read_back().value();
  };
  const std::vector<Separation> first = answers(phase());
  NarrowPhaseSubject two_threads = GetParam();
  const core::EngineRow row = two_threads.row();
  const bool has_threads = std::any_of(row.settings.begin(), row.settings.end(),
                                       [](const core::SettingRow& setting) { return setting.key == "threads"; });
  if (has_threads) two_threads.settings["threads"] = "2";
  const core::Engine other = narrow_phase_engine(two_threads);
  for (core::NarrowPhase* engine : {&phase(), other.narrow_phase.get()}) {
    const std::vector<Separation> again = answers(*engine);
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_TRUE(again[k].distance_m == first[k].distance_m ||
                  (std::isnan(again[k].distance_m) && std::isnan(first[k].distance_m)));
      EXPECT_EQ(again[k].is_touching, first[k].is_touching);
      EXPECT_EQ(again[k].normal, first[k].normal);
      EXPECT_EQ(again[k].witness_a, first[k].witness_a);
      EXPECT_EQ(again[k].witness_b, first[k].witness_b);
    }
  }
}

TEST_P(NarrowPhases, NoPairsAndBadPairs) {
  const core::Mesh cube = box_mesh({0.5F, 0.5F, 0.5F}, 1);
  const core::Scene scene = scene_of({cube, cube});
  ASSERT_TRUE(phase().load(scene).ok());
  const std::vector<Pose> poses(2);
  EXPECT_TRUE(phase().measure({}, poses).ok());
  EXPECT_TRUE(phase().read_back().value().empty());
  for (const core::Pair bad : {core::Pair{0, 2}, core::Pair{1, 1}, core::Pair{1, 0}}) {
    const auto status = phase().measure(std::vector<core::Pair>{bad}, poses);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().line().find("no pair"), std::string::npos) << status.error().line();
  }
  EXPECT_FALSE(phase().measure({}, std::vector<Pose>(1)).ok()) << "fewer poses than bodies";
}

INSTANTIATE_TEST_SUITE_P(Reference, NarrowPhases, testing::ValuesIn(narrow_phase_subjects()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside
