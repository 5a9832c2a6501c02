#include "gpu/shape_tree.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "core/math/box.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Vec3;

// Every third bit.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

// 16 bits per axis of the longest side: cells stay cubes, so that neighbors on the curve are near on every axis.
std::uint64_t morton(Vec3 v, const Box& box, double cells_per_m) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k)
    code |= spread(static_cast<std::uint64_t>((double(v[k]) - double(box.min[k])) * cells_per_m)) << k;
  return code;
}

Box joined(const Box& a, const Box& b) {
  return core::grown(core::grown(a, b.min), b.max);
}

}  // namespace

void append_tree(ShapeTrees& trees, std::span<const Vec3> vertices, std::span<const std::uint32_t> indices,
                 float mean_edge_m) {
  Box bounds = core::empty_box();
  for (const Vec3 v : vertices) bounds = core::grown(bounds, v);
  const Vec3 side = bounds.max - bounds.min;
  const double longest = std::max({side.x, side.y, side.z});
  const double cells_per_m = longest > 0.0 ? 65535.0 / longest : 0.0;

  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) order.emplace_back(morton(vertices[i], bounds, cells_per_m), i);
  std::sort(order.begin(), order.end());

  TreeHeader header;
  header.mean_edge_m = mean_edge_m;
  header.vertex_begin = static_cast<std::uint32_t>(trees.vertices.size());
  std::vector<Box> level;
  for (const auto& [code, k] : order) {
    if ((trees.vertices.size() - header.vertex_begin) % kLeafVertices == 0) level.push_back(core::empty_box());
    level.back() = core::grown(level.back(), vertices[k]);
    trees.vertices.push_back({vertices[k], std::bit_cast<float>(indices[k])});
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  while (trees.vertices.size() % kLeafVertices != 0)
    trees.vertices.push_back({{kFar, kFar, kFar}, std::bit_cast<float>(0xFFFFFFFFU)});

  for (std::uint32_t depth = 0;; ++depth) {
    header.top = depth;
    header.node_begin[depth] = static_cast<std::uint32_t>(trees.nodes.size());
    header.node_count[depth] = static_cast<std::uint32_t>(level.size());
    for (const Box& box : level) trees.nodes.push_back(pack(box));
    if (level.size() <= 1) break;
    std::vector<Box> parents((level.size() + kFanOut - 1) / kFanOut, core::empty_box());
    for (std::size_t n = 0; n < level.size(); ++n) parents[n / kFanOut] = joined(parents[n / kFanOut], level[n]);
    level = std::move(parents);
  }
  trees.headers.push_back(header);
}

}  // namespace broadside::gpu
