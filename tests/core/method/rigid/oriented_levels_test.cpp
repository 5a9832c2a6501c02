// Expected answers: whether points of both boxes, or of both surfaces, come as near as stated, in double.
#include "core/method/rigid/oriented_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/method/rigid/rigid_integrate.hpp"
#include "core/scene/surface_octree.hpp"

namespace broadside::core {
namespace {

using Triple = std::array<double, 3>;

Triple placed(const ContactPose& pose, Vec3 v) {
  const Quat q = pose.q;
  const double n = std::sqrt(double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z);
  const double w = q.w / n;
  const double x = q.x / n;
  const double y = q.y / n;
  const double z = q.z / n;
  return {pose.x.x + (1 - 2 * (y * y + z * z)) * v.x + 2 * (x * y - w * z) * v.y + 2 * (x * z + w * y) * v.z,
          pose.x.y + 2 * (x * y + w * z) * v.x + (1 - 2 * (x * x + z * z)) * v.y + 2 * (y * z - w * x) * v.z,
          pose.x.z + 2 * (x * z - w * y) * v.x + 2 * (y * z + w * x) * v.y + (1 - 2 * (x * x + y * y)) * v.z};
}

Quat random_quat(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const Quat q{normal(random), normal(random), normal(random), normal(random)};
  return (1.0F / std::sqrt(dot(q, q))) * q;
}

float size_of(const Box& b) {
  const Vec3 most{std::max(std::abs(b.min.x), std::abs(b.max.x)), std::max(std::abs(b.min.y), std::abs(b.max.y)),
                  std::max(std::abs(b.min.z), std::abs(b.max.z))};
  return length(most);
}

// In double, by projections on the same 15 axes of exact orientations: the widest gap, relative to unit axes.
double widest_gap(const Box& a, const ContactPose& pa, const Box& b, const ContactPose& pb) {
  std::array<Triple, 8> p;
  std::array<Triple, 8> q;
  for (std::size_t k = 0; k < 8; ++k) {
    p[k] = placed(pa, {k & 1U ? a.max.x : a.min.x, k & 2U ? a.max.y : a.min.y, k & 4U ? a.max.z : a.min.z});
    q[k] = placed(pb, {k & 1U ? b.max.x : b.min.x, k & 2U ? b.max.y : b.min.y, k & 4U ? b.max.z : b.min.z});
  }
  const auto axis = [](const ContactPose& pose, int k) {
    const Triple o = placed({{}, pose.q}, {});
    Triple d = placed({{}, pose.q}, axis_vector(k, 1.0F));
    for (std::size_t i = 0; i < 3; ++i) d[i] -= o[i];
    return d;
  };
  std::vector<Triple> axes;
  for (int i = 0; i < 3; ++i) axes.push_back(axis(pa, i));
  for (int i = 0; i < 3; ++i) axes.push_back(axis(pb, i));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j < 6; ++j) {
      const Triple& u = axes[i];
      const Triple& v = axes[j];
      const Triple c{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      const double size = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
      if (size > 1e-6) axes.push_back({c[0] / size, c[1] / size, c[2] / size});
    }
  double widest = -1e300;
  for (const Triple& d : axes) {
    const auto along = [&d](const Triple& r) { return d[0] * r[0] + d[1] * r[1] + d[2] * r[2]; };
    const auto ends = [&](const std::array<Triple, 8>& r) {
      double low = along(r[0]);
      double high = low;
      for (const Triple& s : r) low = std::min(low, along(s)), high = std::max(high, along(s));
      return std::pair(low, high);
    };
    const auto [la, ha] = ends(p);
    const auto [lb, hb] = ends(q);
    widest = std::max({widest, la - hb, lb - ha});
  }
  return widest;
}

TEST(OrientedLevels, NeverSeparatesBoxesThatMeetAndSeparatesThoseThatAreApart) {
  std::mt19937 random(42);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  int apart = 0;
  int wrong_side = 0;
  for (int k = 0; k < 20000; ++k) {
    // Long and flat boxes, far from the origin too; a quarter of the pairs has parallel axes.
    const float far = k % 5 == 0 ? 1000.0F : 1.0F;
    const auto box = [&] {
      const Vec3 c{0.3F * unit(random), 0.3F * unit(random), 0.3F * unit(random)};
      const Vec3 h{std::pow(10.0F, 1.5F * unit(random) - 1.0F), std::pow(10.0F, 1.5F * unit(random) - 1.0F),
                   std::pow(10.0F, 1.5F * unit(random) - 1.0F)};
      return Box{c - h, c + h};
    };
    const Box a = box();
    const Box b = box();
    const ContactPose pa{{far * unit(random), far * unit(random), far * unit(random)}, random_quat(random)};
    const Vec3 d{1.5F * unit(random), 1.5F * unit(random), 1.5F * unit(random)};
    const ContactPose pb{pa.x + d, k % 4 == 0 ? pa.q : random_quat(random)};
    const RelativePose pose = relative_pose(pa, size_of(a), pb, size_of(b), 0.0F);
    const double gap = widest_gap(a, pa, b, pb);
    const bool found_apart = are_apart(a, b, pose, pose.slack_m);
    if (gap <= 0.0) {
      ASSERT_FALSE(found_apart) << "case " << k << ", overlap " << gap;
    }
    // The cross products of nearly parallel edges are short, so a gap along such an axis alone may be missed: these are
    // counted, not forbidden.
    if (gap > 4.0 * pose.slack_m) {
      ++apart;
      if (!found_apart) ++wrong_side;
    }
  }
  EXPECT_GT(apart, 5000);
  EXPECT_LT(wrong_side, apart / 100);
}

// A wavy sheet that is rolled up: a surface with triangles of many sizes.
Mesh lumpy(int rings, int sides) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const float u = 3.14159F * static_cast<float>(i) / static_cast<float>(rings);
      const float v = 6.28318F * static_cast<float>(j) / static_cast<float>(sides);
      const float r = 0.5F + 0.2F * std::sin(3.0F * u) * std::cos(2.0F * v);
      mesh.vertices.push_back({r * std::sin(u) * std::cos(v), r * std::cos(u), 0.7F * r * std::sin(u) * std::sin(v)});
    }
  const auto at = [sides](int i, int j) { return static_cast<std::uint32_t>(i * sides + j % sides); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TEST(SurfaceOctree, EveryPointOfTheSurfaceIsInABoxOfEachLevel) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const Vec3 center{0.05F, -0.02F, 0.01F};
  for (const auto& [rings, sides] : {std::pair(2, 3), std::pair(6, 5), std::pair(24, 30)}) {
    const Mesh mesh = lumpy(rings, sides);
    const NodeBoxes nodes = surface_node_boxes(mesh, center);
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 20; ++k) {
        float p = unit(random);
        float q = unit(random);
        if (p + q > 1.0F) p = 1.0F - p, q = 1.0F - q;
        const Vec3 a = mesh.vertices[t[0]] - center;
        const Vec3 at = a + (p * (mesh.vertices[t[1]] - center - a) + q * (mesh.vertices[t[2]] - center - a));
        // A point between corners is rounded itself.
        const Box around{at - Vec3{1e-6F, 1e-6F, 1e-6F}, at + Vec3{1e-6F, 1e-6F, 1e-6F}};
        const auto holds = [&](const Box& box) { return overlaps(box, around); };
        ASSERT_TRUE(holds(nodes.root));
        ASSERT_TRUE(std::any_of(nodes.level1, nodes.level1 + nodes.level1_count, holds));
        ASSERT_TRUE(std::any_of(nodes.level2, nodes.level2 + nodes.level2_count, holds));
      }
    for (int p = 0; p < nodes.level1_count; ++p)
      for (int r = nodes.leaf_begin[p]; r < nodes.leaf_begin[p + 1]; ++r)
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_LE(nodes.level1[p].min[axis], nodes.level2[r].min[axis]);
          ASSERT_GE(nodes.level1[p].max[axis], nodes.level2[r].max[axis]);
        }
  }
}

TEST(OrientedLevels, LevelsConfirmWhatTheOnesBelowConfirm) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  const NodeBoxes shapes[] = {surface_node_boxes(lumpy(8, 9), {}), surface_node_boxes(lumpy(2, 3), {0.1F, 0.0F, 0.0F}),
                              single_node_boxes({{-0.5F, -0.1F, -0.2F}, {0.5F, 0.1F, 0.2F}})};
  int confirmed = 0;
  int rejected_below = 0;
  for (int k = 0; k < 900; ++k) {
    const NodeBoxes& a = shapes[k % 3];
    const NodeBoxes& b = shapes[k / 3 % 3];
    const ContactPose pa{{unit(random), unit(random), unit(random)}, random_quat(random)};
    const ContactPose pb{pa.x + 1.2F * Vec3{unit(random), unit(random), unit(random)},
                         k % 7 == 0 ? pa.q : random_quat(random)};
    const float grow_m = k % 2 == 0 ? 0.0F : 0.01F;
    const RelativePose pose = relative_pose(pa, size_of(a.root), pb, size_of(b.root), grow_m);
    std::uint64_t tests = 0;
    const auto holds = [&](Levels levels) { return is_confirmed(levels, a, b, pose, tests); };
    const bool is_a = holds(Levels::kA);
    ASSERT_EQ(holds(Levels::kB), is_a);
    ASSERT_EQ(holds(Levels::kC), is_a);
    if (is_a) {
      ASSERT_TRUE(holds(Levels::kLevel1));
    }
    if (holds(Levels::kLevel1)) {
      ASSERT_TRUE(holds(Levels::kFlat));
    }
    // By the definition, in double: some leaves are not apart.
    double nearest = 1e300;
    for (int p = 0; p < a.level2_count; ++p)
      for (int q = 0; q < b.level2_count; ++q)
        nearest = std::min(nearest, widest_gap(a.level2[p], pa, b.level2[q], pb));
    if (nearest <= grow_m) {
      ASSERT_TRUE(is_a) << "leaves come as near as " << nearest;
    }
    confirmed += is_a ? 1 : 0;
    rejected_below += !is_a && holds(Levels::kFlat) ? 1 : 0;
  }
  EXPECT_GT(confirmed, 150);
  EXPECT_GT(rejected_below, 15);
}

}  // namespace
}  // namespace broadside::core
