// Nearest vertices of one pair of bodies, P(7) and P(8): branch and bound over two vertex trees at once, by one warp or
// by several that share what is left to open.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/search_stack.cuh"
#include "gpu/stages/shape_headers.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// The two trees of a pair, and the nearest vertices that this lane has met. `bound`, in shared memory, has the bits of
// the smallest squared distance that anybody found (of non-negative floats, bits order as values do).
class TreePair {
 public:
  __device__ TreePair(const FrameView& f, const ShapeHeaders& headers, const PlacedShape& a, const PlacedShape& b,
                      std::uint32_t* bound)
      : nodes_(f.shapes.tree_nodes),
        a_(headers.trees[a.shape]),
        b_(headers.trees[b.shape]),
        vertices_a_(f.shapes.tree_vertices + a_.vertex_begin),
        vertices_b_(f.shapes.tree_vertices + b_.vertex_begin),
        xa_(a.x),
        xb_(b.x),
        bound_(bound) {
    const float theta_m = core::pair_theta_m(f.parameters, a_.mean_edge_m, b_.mean_edge_m);
    theta2_ = theta_m * theta_m;
  }

  __device__ NodePair roots() const { return {a_.top << 28, b_.top << 28, 0.0F}; }
  __device__ std::uint32_t top() const { return max(a_.top, b_.top); }
  __device__ float limit() const { return __uint_as_float(*static_cast<volatile std::uint32_t*>(bound_)); }
  // This lane's.
  __device__ core::Proximity best() const { return best_; }

  // By the whole warp: the higher of the two nodes is opened, both when they are level. Calls keep(is_near, pair) twice
  // for every lane, for the children that are near enough.
  template <typename Keep>
  __device__ void open(const NodePair& parents, float limit, const Keep& keep) {
    const std::uint32_t level_a = parents.a >> 28;
    const std::uint32_t level_b = parents.b >> 28;
    const bool opens_a = level_a >= level_b;
    const bool opens_b = level_b >= level_a;
    const std::uint32_t child_level_a = opens_a ? level_a - 1 : level_a;
    const std::uint32_t child_level_b = opens_b ? level_b - 1 : level_b;
    const std::uint32_t first_a = (parents.a & 0xFFFFFFFU) * (opens_a ? kFanOut : 1U);
    const std::uint32_t first_b = (parents.b & 0xFFFFFFFU) * (opens_b ? kFanOut : 1U);
    const std::uint32_t count_a = opens_a ? min(kFanOut, a_.node_count[child_level_a] - first_a) : 1U;
    const std::uint32_t count_b = opens_b ? min(kFanOut, b_.node_count[child_level_b] - first_b) : 1U;

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
        keeps = gap2 < theta2_ && gap2 <= limit;
      }
      keep(keeps, NodePair{child_level_a << 28 | (first_a + p), child_level_b << 28 | (first_b + q), gap2});
    }
    __syncwarp();
  }

  // By the whole warp: up to four pairs of leaves, eight lanes a pair: a lane has one vertex of A and meets eight of B.
  // Four at once, because what takes the time is waiting for the vertices.
  __device__ void meet(bool has_leaves, const NodePair& leaves, float limit) {
    if (has_leaves && leaves.gap2 <= limit) {
      const PackedVec3 mine = fetched(vertices_a_ + leaves.a * kLeafVertices + lane() % 8);
      const PackedVec3* of_b = vertices_b_ + leaves.b * kLeafVertices;
      const core::Vec3 va = mine.v + xa_;
#pragma unroll 4
      for (std::uint32_t t = 0; t < kLeafVertices; ++t) {
        const PackedVec3 other = fetched(of_b + t);
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

 private:
  __device__ core::Box box(const TreeHeader& tree, std::uint32_t level, std::uint32_t node, core::Vec3 x) const {
    return core::translated(fetched(nodes_ + tree.node_begin[level] + node), x);
  }

  const PackedBox* nodes_;
  const TreeHeader& a_;
  const TreeHeader& b_;
  const PackedVec3* vertices_a_;
  const PackedVec3* vertices_b_;
  core::Vec3 xa_;
  core::Vec3 xb_;
  std::uint32_t* bound_;
  float theta2_ = 0.0F;
  core::Proximity best_;
};

// By one warp, with a stack of its own. Returns each lane's nearest.
__device__ inline core::Proximity nearest_by_trees(TreePair trees, const SearchStack& stack) {
  if (lane() == 0) stack.put(0, trees.roots());
  std::uint32_t size = 1;
  __syncwarp();
  while (size > 0) {
    const float limit = trees.limit();
    // Groups of eight lanes look at the upmost four; if those from the first on are leaves, they are met.
    const std::uint32_t group = lane() / 8;
    const NodePair one = stack.at(size - 1 - min(group, size - 1));
    const unsigned are_leaves = __ballot_sync(kFullWarp, group < size && one.are_leaves());
    if ((are_leaves & 1U) != 0) {
      const std::uint32_t taken =
          are_leaves == kFullWarp ? 4U : static_cast<std::uint32_t>(__ffs(~are_leaves) - 1) / 8U;
      size -= taken;
      trees.meet(group < taken, one, limit);
      continue;
    }
    const NodePair parents = stack.at(size - 1);
    --size;
    __syncwarp();
    if (parents.gap2 > limit) continue;
    trees.open(parents, limit, [&](bool is_near, const NodePair& children) {
      const unsigned kept = __ballot_sync(kFullWarp, is_near);
      if (is_near) stack.put(size + __popc(kept & ((1U << lane()) - 1U)), children);
      size += static_cast<std::uint32_t>(__popc(kept));
    });
  }
  return trees.best();
}

// More than a round of a few warps: worth handing over.
__device__ inline bool is_much(const TeamCounts& left) {
  constexpr std::uint32_t kWarps = 4;
  return 4 * left.nodes + left.leaves >= 4 * kWarps;
}

// Several warps of a block that search one pair.
struct SearchTeam : WarpShare {  // of two or more
  std::uint32_t barrier = 0;     // the team's number in its block
  SearchStack stack;             // of all members together
  // By turns: how many pairs of nodes and of leaves are left. In shared memory.
  TeamCounts* counts = nullptr;

  __device__ void sync() const { sync_warps(barrier, members); }
  // The stack is two: a round makes no more than 64 pairs of leaves a warp.
  __device__ SearchStack nodes() const { return stack.first(stack.entries - 64 * members); }
  __device__ SearchStack leaves() const { return stack.from(stack.entries - 64 * members); }
  // Entry k of a stack that holds so many.
  __device__ void put(const TeamCounts& of, std::uint32_t k, const NodePair& p) const {
    k < of.nodes ? nodes().put(k, p) : leaves().put(k - of.nodes, p);
  }
  __device__ NodePair at(const TeamCounts& of, std::uint32_t k) const {
    return k < of.nodes ? nodes().at(k) : leaves().at(k - of.nodes);
  }
};

// By one warp of a team: what it finds below these nodes goes to the stack, and is counted.
__device__ inline void open_for_team(TreePair& trees, const SearchTeam& team, const NodePair& parents, float limit,
                                     TeamCounts& counts) {
  trees.open(parents, limit, [&](bool is_near, const NodePair& children) {
    const unsigned kept = __ballot_sync(kFullWarp, is_near);
    if (kept == 0) return;
    const bool are_leaves = children.are_leaves();  // the same in all lanes
    std::uint32_t first = 0;
    if (lane() == 0)
      first = atomicAdd(are_leaves ? &counts.leaves : &counts.nodes, static_cast<std::uint32_t>(__popc(kept)));
    first = __shfl_sync(kFullWarp, first, 0);
    if (is_near)
      (are_leaves ? team.leaves() : team.nodes()).put(first + __popc(kept & ((1U << lane()) - 1U)), children);
  });
}

// The start of a search, by all warps of a team. Returns what the stack holds.
__device__ inline TeamCounts begin_at_roots(TreePair& trees, const SearchTeam& team) {
  if (team.member == 0) {
    const NodePair roots = trees.roots();
    if (lane() == 0) team.counts[0] = {0, roots.are_leaves() ? 1U : 0U};
    __syncwarp();
    if (!roots.are_leaves())
      open_for_team(trees, team, roots, INFINITY, team.counts[0]);
    else if (lane() == 0)
      team.leaves().put(0, roots);
  }
  team.sync();
  return team.counts[0];
}

// By all warps of a team, in rounds: each opens a pair of nodes or meets four pairs of leaves, from the upmost on.
// Where surfaces meet, nearly all the work is below one pair of upper nodes, so it cannot be dealt out beforehand.
//
// `left`: what the stack holds. `rest`: a RestOfPair or NoRest (search_rests.cuh). Returns each lane's nearest.
template <typename Rest>
__device__ core::Proximity nearest_by_trees(TreePair trees, const SearchTeam& team, TeamCounts left, Rest& rest) {
  const SearchStack nodes = team.nodes();
  const SearchStack leaves = team.leaves();
  // One warp alone, opening one pair after the other, never adds more than this.
  const std::uint32_t reserve = 63 * trees.top();
  for (std::uint32_t round = 1; left.any(); ++round) {
    // What all members do follows from what is left, so that they agree without a word.
    const std::uint32_t groups = min(team.members, left.nodes > 0 ? left.leaves / 4 : (left.leaves + 3) / 4);
    const std::uint32_t met = min(4 * groups, left.leaves);
    std::uint32_t opened = min(min(team.members - groups, left.nodes), (leaves.entries - (left.leaves - met)) / 64);
    const std::uint32_t spare = nodes.entries > reserve + left.nodes ? (nodes.entries - reserve - left.nodes) / 63 : 0U;
    opened = min(opened, max(spare, 1U));
    const bool meets = team.member < groups;
    const bool opens = !meets && team.member - groups < opened;
    const std::uint32_t leaf = 4 * team.member + lane() / 8;
    NodePair own;
    if (meets && leaf < met) own = leaves.at(left.leaves - 1 - leaf);
    if (opens) own = nodes.at(left.nodes - 1 - (team.member - groups));
    TeamCounts& next = team.counts[round % 2];
    if (team.member == 0 && lane() == 0) next = {left.nodes - opened, left.leaves - met};
    team.sync();
    const float limit = trees.limit();
    if (meets) trees.meet(leaf < met, own, limit);
    if (opens && own.gap2 <= limit) open_for_team(trees, team, own, limit, next);
    team.sync();
    left = next;
    if (rest.is_asked_after(round) && is_much(left) && rest.hand_over(team, left, trees.limit())) break;
  }
  return trees.best();
}

}  // namespace broadside::gpu
