#include "reference/scene_octree/scene_octree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace broadside::reference {
namespace {

using core::Box;
using core::Pair;

// Candidates are tested this many at a time into one byte each, a loop that compilers turn into vector compares.
constexpr std::uint32_t kTile = 64;
constexpr std::size_t kTreeGrain = 256;

}  // namespace

SceneOctree::SceneOctree(int depth, core::Variant variant)
    : depth_(std::clamp(depth, 0, core::kMaxSceneOctreeDepth)), same_node_only_(variant == core::Variant::kE2) {
  if (variant == core::Variant::kE7) depth_ = std::min(depth_, 1);
}

void SceneOctree::build(std::span<const Box> boxes, std::span<const std::uint8_t> is_static, const Box& domain) {
  const std::size_t n = boxes.size();
  domain_ = domain;
  const core::SceneGrid grid = core::make_scene_grid(domain, depth_);
  nodes_.resize(n);
  order_.resize(n);
  using Places = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Places(0, n, kTreeGrain), [&](const Places& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      nodes_[i] = core::scene_node(grid, boxes[i]);
      order_[i] = static_cast<std::uint64_t>(nodes_[i].key) << 32U | i;
    }
  });
  tbb::parallel_sort(order_.begin(), order_.end());

  for (auto* axis : {&min_x_, &min_y_, &min_z_, &max_x_, &max_y_, &max_z_}) axis->resize(n + kTile);
  id_.resize(n);
  is_static_.resize(n + kTile);
  range_end_.resize(n);
  tbb::parallel_for(Places(0, n, kTreeGrain), [&](const Places& range) {
    for (std::size_t place = range.begin(); place != range.end(); ++place) {
      const auto id = static_cast<std::uint32_t>(order_[place]);
      const Box& box = boxes[id];
      id_[place] = id;
      is_static_[place] = is_static[id] != 0 ? 1 : 0;
      min_x_[place] = box.min.x;
      min_y_[place] = box.min.y;
      min_z_[place] = box.min.z;
      max_x_[place] = box.max.x;
      max_y_[place] = box.max.y;
      max_z_[place] = box.max.z;
      const core::SceneNode node = nodes_[id];
      if (place > range.begin() && node == nodes_[id_[place - 1U]]) {
        range_end_[place] = range_end_[place - 1U];
        continue;
      }
      const std::uint32_t end_key = same_node_only_ ? node.key + 1U : node.subtree_end;
      const auto end = std::lower_bound(order_.begin() + static_cast<std::ptrdiff_t>(place), order_.end(),
                                        static_cast<std::uint64_t>(end_key) << 32U);
      range_end_[place] = static_cast<std::uint32_t>(end - order_.begin());
    }
  });
  tests_ = 0;
  for (std::size_t place = 0; place < n; ++place) tests_ += range_end_[place] - place - 1U;
}

void SceneOctree::find() {
  found_.clear();
  using Places = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Places(0, id_.size(), 16), [&](const Places& range) {
    PairWriter& writer = found_.writer();
    for (std::size_t place = range.begin(); place != range.end(); ++place) {
      const Box a{{min_x_[place], min_y_[place], min_z_[place]}, {max_x_[place], max_y_[place], max_z_[place]}};
      const std::uint32_t id = id_[place];
      const std::uint8_t static_a = is_static_[place];
      const std::uint32_t end = range_end_[place];
      for (std::uint32_t first = static_cast<std::uint32_t>(place) + 1U; first < end; first += kTile) {
        std::array<std::uint8_t, kTile> hit;
        // The arrays are padded by a tile, so reading past the end is harmless; hits there are not looked at.
        for (std::uint32_t k = 0; k < kTile; ++k) {
          const std::uint32_t b = first + k;
          // & instead of &&: all tests run in vector lanes, without branches.
          // NOLINTNEXTLINE(clang-diagnostic-bitwise-instead-of-logical)
          hit[k] = static_cast<std::uint8_t>((a.min.x <= max_x_[b]) & (min_x_[b] <= a.max.x) & (a.min.y <= max_y_[b]) &
                                             (min_y_[b] <= a.max.y) & (a.min.z <= max_z_[b]) & (min_z_[b] <= a.max.z) &
                                             ((static_a & is_static_[b]) == 0));
        }
        const std::uint32_t count = std::min(kTile, end - first);
        Pair* to = writer.room(kTile);
        for (std::uint32_t k = 0; k < count; k += 8U) {
          std::uint64_t eight = 0;
          std::memcpy(&eight, hit.data() + k, sizeof eight);
          if (eight == 0) continue;
          for (std::uint32_t lane = k; lane < std::min(k + 8U, count); ++lane)
            if (hit[lane] != 0) *to++ = core::make_pair_of(id, id_[first + lane]);
        }
        writer.commit(to);
      }
    }
  });
}

void SceneOctree::tell_octree(std::vector<core::OctreeNode>& nodes, std::vector<std::uint32_t>& node_of_body) const {
  nodes.clear();
  nodes.push_back({domain_, 0, core::kNoNode, core::kNoNode, 0});
  // The first node of each level. Node k of a level has the Morton code k.
  std::array<std::uint32_t, core::kMaxSceneOctreeDepth + 2> first{0, 1};
  for (int level = 1; level <= depth_; ++level) {
    const std::uint32_t parents = first[level] - first[level - 1];
    for (std::uint32_t p = first[level - 1]; p < first[level - 1] + parents; ++p) {
      nodes[p].first_child = static_cast<std::uint32_t>(nodes.size());
      nodes[p].child_count = 8;
      const Box cell = nodes[p].box;
      const core::Vec3 middle = core::center(cell);
      for (int octant = 0; octant < 8; ++octant) {
        Box child = cell;
        for (int axis = 0; axis < 3; ++axis) ((octant >> axis & 1) != 0 ? child.min : child.max)[axis] = middle[axis];
        nodes.push_back({child, static_cast<std::uint32_t>(level), p, core::kNoNode, 0});
      }
    }
    first[level + 1] = static_cast<std::uint32_t>(nodes.size());
  }
  node_of_body.clear();
  for (const core::SceneNode& node : nodes_) {
    const std::uint32_t code = node.key >> 4U >> (3U * static_cast<std::uint32_t>(depth_ - node.level()));
    node_of_body.push_back(first[node.level()] + code);
  }
}

void SceneOctree::read_back(std::vector<Pair>& out) {
  pair_order_.order(found_.gather(), static_cast<std::uint32_t>(id_.size()), out);
}

void SceneOctree::find_pairs(std::span<const Box> boxes, std::span<const std::uint8_t> is_static, const Box& domain,
                             std::vector<Pair>& out) {
  build(boxes, is_static, domain);
  find();
  read_back(out);
}

}  // namespace broadside::reference
