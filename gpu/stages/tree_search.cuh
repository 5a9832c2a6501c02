// Nearest vertices of one pair of bodies, P(7) and P(8): branch and bound over two vertex trees at once.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/search_stack.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// The search of one pair of bodies by the `members` warps of one block that share `bound`: the bits of the smallest
// squared distance found so far by any of them (of non-negative floats, bits order as values do).
class NearestVertices {
 public:
  __device__ NearestVertices(const FrameView& f, core::Pair pair, SearchStack stack, std::uint32_t* bound,
                             std::uint32_t member, std::uint32_t members)
      : nodes_(f.shapes.tree_nodes),
        vertices_(f.shapes.tree_vertices),
        a_(f.shapes.trees[f.shape_of_body[pair.i]]),
        b_(f.shapes.trees[f.shape_of_body[pair.j]]),
        xa_(f.detected.position[pair.i].v),
        xb_(f.detected.position[pair.j].v),
        stack_(stack),
        bound_(bound),
        member_(member),
        members_(members) {
    const float theta_m = core::pair_theta_m(f.parameters, a_.mean_edge_m, b_.mean_edge_m);
    theta2_ = theta_m * theta_m;
    // Where the trees have some 8 to 64 nodes the pairs of nodes are dealt out to the warps; above it all do the same.
    const std::uint32_t top = min(a_.top, b_.top);
    split_ = top > 2 ? top - 2 : 0;
  }

  __device__ core::Proximity find() {
    if (a_.top != split_ || b_.top != split_ || is_mine(0, 0)) push_root();
    while (size_ > 0) {
      const float limit = __uint_as_float(*static_cast<volatile std::uint32_t*>(bound_));
      const std::uint32_t a = stack_.a[size_ - 1];
      const std::uint32_t b = stack_.b[size_ - 1];
      const float gap2 = __uint_as_float(stack_.c[size_ - 1]);
      if ((a | b) >> 28 == 0) {
        meet_leaves(limit);
        continue;
      }
      --size_;
      __syncwarp();
      if (gap2 <= limit) meet_children(a, b, limit);
    }
    return warp_nearest(best_);
  }

 private:
  __device__ bool is_mine(std::uint32_t node_a, std::uint32_t node_b) const {
    return ((node_a * 0x9E3779B1U + node_b * 0x85EBCA6BU) >> 16) % members_ == member_;
  }

  __device__ void push_root() {
    if (lane() == 0) {
      stack_.a[0] = a_.top << 28;
      stack_.b[0] = b_.top << 28;
      stack_.c[0] = __float_as_uint(0.0F);
    }
    size_ = 1;
    __syncwarp();
  }

  __device__ core::Box box(const TreeHeader& tree, std::uint32_t level, std::uint32_t node, core::Vec3 x) const {
    return core::translated(unpack(nodes_[tree.node_begin[level] + node]), x);
  }

  // The higher of the two nodes is opened, both when they are level.
  __device__ void meet_children(std::uint32_t a, std::uint32_t b, float limit) {
    const std::uint32_t level_a = a >> 28;
    const std::uint32_t level_b = b >> 28;
    const bool opens_a = level_a >= level_b;
    const bool opens_b = level_b >= level_a;
    const std::uint32_t child_level_a = opens_a ? level_a - 1 : level_a;
    const std::uint32_t child_level_b = opens_b ? level_b - 1 : level_b;
    const std::uint32_t first_a = (a & 0xFFFFFFFU) * (opens_a ? kFanOut : 1U);
    const std::uint32_t first_b = (b & 0xFFFFFFFU) * (opens_b ? kFanOut : 1U);
    const std::uint32_t count_a = opens_a ? min(kFanOut, a_.node_count[child_level_a] - first_a) : 1U;
    const std::uint32_t count_b = opens_b ? min(kFanOut, b_.node_count[child_level_b] - first_b) : 1U;
    const bool is_split = child_level_a == split_ && child_level_b == split_;

    const std::uint32_t q = lane() % 8;
    core::Box box_b;
    if (q < count_b) box_b = box(b_, child_level_b, first_b + q, xb_);
#pragma unroll
    for (std::uint32_t half = 0; half < 2; ++half) {
      const std::uint32_t p = lane() / 8 + 4 * half;
      float gap2 = 0.0F;
      bool keeps = p < count_a && q < count_b;
      if (keeps) {
        gap2 = squared_gap(box(a_, child_level_a, first_a + p, xa_), box_b);
        keeps = gap2 < theta2_ && gap2 <= limit && (!is_split || is_mine(first_a + p, first_b + q));
      }
      const unsigned kept = __ballot_sync(kFullWarp, keeps);
      if (keeps) {
        const std::uint32_t place = size_ + __popc(kept & ((1U << lane()) - 1U));
        stack_.a[place] = child_level_a << 28 | (first_a + p);
        stack_.b[place] = child_level_b << 28 | (first_b + q);
        stack_.c[place] = __float_as_uint(gap2);
      }
      size_ += __popc(kept);
    }
    __syncwarp();
  }

  // Up to four pairs of leaves from the top of the stack, eight lanes a pair: a lane has one vertex of A and meets
  // eight of B. Four at once, because what takes the time is waiting for the vertices.
  __device__ void meet_leaves(float limit) {
    const std::uint32_t group = lane() / 8;
    const std::uint32_t entry = size_ - 1 - min(group, size_ - 1);
    const std::uint32_t a = stack_.a[entry];
    const std::uint32_t b = stack_.b[entry];
    const float gap2 = __uint_as_float(stack_.c[entry]);
    const unsigned are_leaves = __ballot_sync(kFullWarp, group < size_ && (a | b) >> 28 == 0);
    // Groups from the first on, as far as they all have leaves: each has eight lanes' bits.
    const std::uint32_t taken = are_leaves == kFullWarp ? 4U : static_cast<std::uint32_t>(__ffs(~are_leaves) - 1) / 8U;
    size_ -= taken;
    if (group < taken && gap2 <= limit) {
      const PackedVec3 mine = vertices_[a_.vertex_begin + a * kLeafVertices + lane() % 8];
      const PackedVec3* of_b = vertices_ + b_.vertex_begin + b * kLeafVertices;
      const core::Vec3 va = mine.v + xa_;
#pragma unroll 4
      for (std::uint32_t t = 0; t < kLeafVertices; ++t) {
        const PackedVec3 other = of_b[t];
        const float d2 = core::squared_distance(va, other.v + xb_);
        if (!(d2 < theta2_) || d2 > best_.squared_distance_m2) continue;
        const core::Proximity found{d2, __float_as_uint(mine.w), __float_as_uint(other.w)};
        if (core::is_nearer(found, best_)) best_ = found;
      }
    }
    const std::uint32_t least = warp_min(__float_as_uint(best_.squared_distance_m2));
    if (lane() == 0 && least < *static_cast<volatile std::uint32_t*>(bound_)) atomicMin(bound_, least);
    __syncwarp();
  }

  const PackedBox* nodes_;
  const PackedVec3* vertices_;
  const TreeHeader& a_;
  const TreeHeader& b_;
  core::Vec3 xa_;
  core::Vec3 xb_;
  SearchStack stack_;
  std::uint32_t size_ = 0;
  std::uint32_t* bound_;
  std::uint32_t member_;
  std::uint32_t members_;
  std::uint32_t split_ = 0;
  float theta2_ = 0.0F;
  core::Proximity best_;
};

}  // namespace broadside::gpu
