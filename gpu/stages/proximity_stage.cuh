// Nearest vertices of each confirmed pair, P(7) and P(8): branch and bound over two vertex trees at once.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// One warp's stack of node pairs, in shared memory. A node is level << 28 | index.
struct NodePairStack {
  std::uint32_t* a = nullptr;
  std::uint32_t* b = nullptr;
  float* gap2 = nullptr;
  std::uint32_t size = 0;
};

constexpr std::uint32_t kBytesPerStackEntry = 12;

// Squared distance of two boxes in the arithmetic of core::squared_distance. Rounding is monotone in every operation of
// it, so no vertex in one box and vertex in the other have a smaller rounded squared distance than this: what is
// skipped by it could not have been the nearest.
__device__ inline float squared_gap(const core::Box& a, const core::Box& b) {
  const auto gap = [](float a_min, float a_max, float b_min, float b_max) {
    return fmaxf(0.0F, fmaxf(a_min - b_max, b_min - a_max));
  };
  const core::Vec3 g{gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                     gap(a.min.z, a.max.z, b.min.z, b.max.z)};
  return core::dot(g, g);
}

__device__ inline core::Proximity warp_nearest(core::Proximity mine) {
  for (unsigned step = 16; step > 0; step /= 2) {
    core::Proximity other;
    other.squared_distance_m2 = __shfl_xor_sync(kFullWarp, mine.squared_distance_m2, step);
    other.vertex_a = __shfl_xor_sync(kFullWarp, mine.vertex_a, step);
    other.vertex_b = __shfl_xor_sync(kFullWarp, mine.vertex_b, step);
    if (core::is_nearer(other, mine)) mine = other;
  }
  return mine;
}

// The search of one pair of bodies by the `members` warps of one block that share `bound`: the bits of the smallest
// squared distance found so far by any of them (of non-negative floats, bits order as values do).
class NearestVertices {
 public:
  __device__ NearestVertices(const FrameView& f, core::Pair pair, NodePairStack stack, std::uint32_t* bound,
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
    while (stack_.size > 0) {
      const float limit = __uint_as_float(*static_cast<volatile std::uint32_t*>(bound_));
      const std::uint32_t a = stack_.a[stack_.size - 1];
      const std::uint32_t b = stack_.b[stack_.size - 1];
      const float gap2 = stack_.gap2[stack_.size - 1];
      if ((a | b) >> 28 == 0) {
        meet_leaves(limit);
        continue;
      }
      --stack_.size;
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
      stack_.gap2[0] = 0.0F;
    }
    stack_.size = 1;
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
        const std::uint32_t place = stack_.size + __popc(kept & ((1U << lane()) - 1U));
        stack_.a[place] = child_level_a << 28 | (first_a + p);
        stack_.b[place] = child_level_b << 28 | (first_b + q);
        stack_.gap2[place] = gap2;
      }
      stack_.size += __popc(kept);
    }
    __syncwarp();
  }

  // Up to four pairs of leaves from the top of the stack, eight lanes a pair: a lane has one vertex of A and meets
  // eight of B. Four at once, because what takes the time is waiting for the vertices.
  __device__ void meet_leaves(float limit) {
    const std::uint32_t group = lane() / 8;
    const std::uint32_t entry = stack_.size - 1 - min(group, stack_.size - 1);
    const std::uint32_t a = stack_.a[entry];
    const std::uint32_t b = stack_.b[entry];
    const float gap2 = stack_.gap2[entry];
    const unsigned are_leaves = __ballot_sync(kFullWarp, group < stack_.size && (a | b) >> 28 == 0);
    // Groups from the first on, as far as they all have leaves: each has eight lanes' bits.
    const std::uint32_t taken = are_leaves == kFullWarp ? 4U : static_cast<std::uint32_t>(__ffs(~are_leaves) - 1) / 8U;
    stack_.size -= taken;
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
  NodePairStack stack_;
  std::uint32_t* bound_;
  std::uint32_t member_;
  std::uint32_t members_;
  std::uint32_t split_ = 0;
  float theta2_ = 0.0F;
  core::Proximity best_;
};

constexpr std::uint32_t kMaxBlockWarps = 32;

// Shared memory of a block: what the warps of one pair share.
struct ProximityScratch {
  std::uint32_t bound[kMaxBlockWarps];
  core::Proximity part[kMaxBlockWarps];
};

__device__ inline NodePairStack stack_of_warp(const FrameView& f, void* stacks) {
  const std::uint32_t entries = f.stack_entries;
  NodePairStack stack;
  stack.a = static_cast<std::uint32_t*>(stacks) + std::uint64_t{threadIdx.x / 32} * entries * 3;
  stack.b = stack.a + entries;
  stack.gap2 = reinterpret_cast<float*>(stack.b + entries);
  return stack;
}

// A warp a pair. Pairs take very unequal times, so a warp takes new ones when it is done with its own; several at once
// where there are very many, because all warps take from one counter.
__device__ inline void measure_by_warps(const FrameView& f, std::uint64_t count, ProximityScratch& scratch,
                                        void* stacks) {
  const std::uint64_t warps = std::uint64_t{gridDim.x} * (blockDim.x / 32);
  const std::uint64_t share = max(std::uint64_t{1}, min(std::uint64_t{8}, count / (warps * 32)));
  std::uint32_t* bound = &scratch.bound[threadIdx.x / 32];
  const NodePairStack stack = stack_of_warp(f, stacks);
  for (;;) {
    unsigned long long first = 0;
    if (lane() == 0) first = atomicAdd(&f.counters->measured, static_cast<unsigned long long>(share));
    first = __shfl_sync(kFullWarp, first, 0);
    if (first >= count) return;
    for (std::uint64_t k = first; k < min(std::uint64_t{first} + share, count); ++k) {
      if (lane() == 0) *bound = __float_as_uint(INFINITY);
      __syncwarp();
      const core::Proximity best = NearestVertices(f, f.confirmed.items[k], stack, bound, 0, 1).find();
      if (lane() == 0) f.proximity[k] = best;
      __syncwarp();
    }
  }
}

// When there are fewer pairs than warps, several warps of a block share a pair. The block's warps are a power of two.
__device__ inline void measure_proximity(const FrameView& f, std::uint64_t count, ProximityScratch& scratch,
                                         void* stacks) {
  const std::uint32_t warps = blockDim.x / 32;
  const std::uint32_t warp = threadIdx.x / 32;
  std::uint32_t members = 1;
  while (members < warps && count * members * 2 <= std::uint64_t{gridDim.x} * warps) members *= 2;
  if (members == 1) return measure_by_warps(f, count, scratch, stacks);
  const std::uint32_t teams = warps / members;
  const std::uint32_t team = warp / members;
  const std::uint32_t member = warp % members;
  const NodePairStack stack = stack_of_warp(f, stacks);

  // The same number of turns for every warp of the block, because a pair's warps meet at its barrier.
  for (std::uint64_t base = 0; base < count; base += std::uint64_t{teams} * gridDim.x) {
    const std::uint64_t k = base + std::uint64_t{team} * gridDim.x + blockIdx.x;
    if (member == 0 && lane() == 0) scratch.bound[team] = __float_as_uint(INFINITY);
    __syncthreads();
    core::Proximity best;
    if (k < count) best = NearestVertices(f, f.confirmed.items[k], stack, &scratch.bound[team], member, members).find();
    if (lane() == 0) scratch.part[warp] = best;
    __syncthreads();
    for (std::uint32_t m = 1; member == 0 && m < members; ++m)
      if (core::is_nearer(scratch.part[warp + m], best)) best = scratch.part[warp + m];
    if (member == 0 && lane() == 0 && k < count) f.proximity[k] = best;
  }
}

}  // namespace broadside::gpu
