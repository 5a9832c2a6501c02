// Columns in device memory equal those that are read back. Here the device is the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <tuple>
#include <vector>

#include "datasets/scenes.hpp"
#include "gpu/pipeline_by_motion.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

PipelineByMotion octree_gpu() {
  return PipelineByMotion({}, {}, "octree-cpu", core::Done{});
}

// The rows of one column, packed.
template <typename T>
std::vector<T> column(const core::DeviceFrame& frame, std::string_view path) {
  for (const core::DeviceColumn& c : frame.columns) {
    if (c.path != path) continue;
    EXPECT_EQ(sizeof(T), c.width * sizeof(float)) << path;
    std::vector<T> rows(c.rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::memcpy(static_cast<void*>(&rows[i]), static_cast<const char*>(c.data) + i * c.row_bytes, sizeof(T));
    return rows;
  }
  ADD_FAILURE() << "no column " << path;
  return {};
}

template <typename T>
std::vector<T> sorted(std::vector<T> rows) {
  std::sort(rows.begin(), rows.end());
  return rows;
}

using PointRow = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, float, float, float, float>;

std::vector<PointRow> points_of(const core::DeviceFrame& frame) {
  const auto a = column<std::uint32_t>(frame, "point/a");
  const auto b = column<std::uint32_t>(frame, "point/b");
  const auto feature = column<std::uint32_t>(frame, "point/feature");
  const auto gap = column<float>(frame, "point/gap");
  const auto impulse = column<core::Vec3>(frame, "point/impulse");
  const auto place = column<core::Vec3>(frame, "point/point");
  const auto normal = column<core::Vec3>(frame, "point/normal");
  std::vector<PointRow> rows;
  for (std::size_t k = 0; k < a.size(); ++k)
    rows.emplace_back(a[k], b[k], feature[k], gap[k], impulse[k].y, place[k].x, normal[k].z);
  return sorted(std::move(rows));
}

std::vector<PointRow> points_of(const core::FrameRecord& frame) {
  std::vector<PointRow> rows;
  for (const core::ContactPoint& p : frame.points)
    rows.emplace_back(p.a, p.b, p.feature, p.gap_m, p.impulse.y, p.point.x, p.normal.z);
  return sorted(std::move(rows));
}

TEST(FrameOnDeviceOnHost, OfTranslatingBodiesIsWhatIsReadBack) {
  const core::Scene scene = thrown_spheres(4, 6, 30, 3.0F, 3);
  PipelineByMotion pipeline = octree_gpu();
  ASSERT_TRUE(pipeline.load(scene).ok());
  std::size_t pairs_seen = 0;
  for (int step = 0; step <= 4; ++step) {
    SCOPED_TRACE(step);
    if (step > 0) {
      ASSERT_TRUE(pipeline.step(scene.dt_s).ok());
    }
    auto there = pipeline.frame_on_device();
    core::FrameRecord frame;
    ASSERT_TRUE(pipeline.read_back(frame, core::RecordLevel::kFull).ok());
    ASSERT_TRUE(there.ok());
    EXPECT_TRUE(column<core::Vec3>(there.value(), "body/position") == frame.position);
    EXPECT_TRUE(column<core::Vec3>(there.value(), "body/velocity") == frame.velocity);
    const auto pairs = sorted(column<core::Pair>(there.value(), "pairs/pairs"));
    EXPECT_TRUE(pairs == frame.pairs);
    pairs_seen += pairs.size();
  }
  EXPECT_GT(pairs_seen, 0U);
}

// Returns the largest number of parts in which a step was taken.
std::uint32_t expect_what_is_read_back(const core::Scene& scene, int steps) {
  PipelineByMotion pipeline = octree_gpu();
  EXPECT_TRUE(pipeline.load(scene).ok());
  std::size_t points_seen = 0;
  std::uint32_t most_parts = 0;
  for (int step = 0; step <= steps; ++step) {
    SCOPED_TRACE(step);
    if (step > 0) {
      EXPECT_TRUE(pipeline.step(scene.dt_s).ok());
    }
    auto there = pipeline.frame_on_device();
    core::FrameRecord frame;
    EXPECT_TRUE(pipeline.read_back(frame, core::RecordLevel::kFull).ok());
    EXPECT_TRUE(there.ok());
    if (!there.ok()) return 0;
    EXPECT_TRUE(column<core::Vec3>(there.value(), "body/position") == frame.position);
    EXPECT_TRUE(column<core::Quat>(there.value(), "body/orientation") == frame.orientation);
    EXPECT_TRUE(column<core::Vec3>(there.value(), "body/velocity") == frame.velocity);
    EXPECT_TRUE(column<core::Vec3>(there.value(), "body/angular_velocity") == frame.angular_velocity);
    EXPECT_TRUE(sorted(column<core::Pair>(there.value(), "pairs/pairs")) == frame.pairs);
    EXPECT_TRUE(sorted(column<core::Pair>(there.value(), "confirmed/pairs")) == frame.confirmed);
    EXPECT_TRUE(points_of(there.value()) == points_of(frame));
    for (const core::DeviceColumn& c : there.value().columns)
      EXPECT_EQ(c.row_bytes, c.width * sizeof(float)) << c.path << ": JAX takes packed rows alone";
    points_seen += frame.points.size();
    most_parts = std::max(most_parts, frame.parts);
  }
  EXPECT_GT(points_seen, 0U);
  return most_parts;
}

TEST(FrameOnDeviceOnHost, OfTurningBodiesIsWhatIsReadBack) {
  auto made = datasets::make_scene("rigid:tip:push-tips", {});
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(expect_what_is_read_back(made.value(), 5), 1U);
}

// A step in parts, whose parts are put together on the host.
TEST(FrameOnDeviceOnHost, OfAStepInPartsIsWhatIsReadBack) {
  auto made = datasets::make_scene("rigid:stack:5", {});
  ASSERT_TRUE(made.ok());
  core::Scene scene = std::move(made).value();
  for (core::Body& body : scene.bodies) body.velocity = {1.0F, -30.0F, 0.0F};
  EXPECT_EQ(expect_what_is_read_back(scene, 3), 4U);
}

TEST(FrameOnDeviceOnHost, IsMadeOnceAStepAndAgainOfAnotherScene) {
  auto tip = datasets::make_scene("rigid:tip:push-tips", {});
  auto stack = datasets::make_scene("rigid:stack:5", {});
  ASSERT_TRUE(tip.ok() && stack.ok());
  PipelineByMotion pipeline = octree_gpu();
  for (const core::Scene* scene : {&tip.value(), &stack.value()}) {
    ASSERT_TRUE(pipeline.load(*scene).ok());
    for (int step = 0; step < 2; ++step) {
      core::FrameRecord frame;
      ASSERT_TRUE(pipeline.read_back(frame, core::RecordLevel::kFull).ok());
      for (int call = 0; call < 2; ++call) {
        auto there = pipeline.frame_on_device();
        ASSERT_TRUE(there.ok());
        EXPECT_TRUE(column<core::Vec3>(there.value(), "body/position") == frame.position);
        EXPECT_TRUE(points_of(there.value()) == points_of(frame));
      }
      ASSERT_TRUE(pipeline.step(scene->dt_s).ok());
    }
  }
}

TEST(FrameOnDeviceOnHost, OfNoSceneIsRefused) {
  PipelineByMotion pipeline = octree_gpu();
  EXPECT_FALSE(pipeline.frame_on_device().ok());
}

}  // namespace
}  // namespace broadside::gpu
