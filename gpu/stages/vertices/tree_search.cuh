// Nearest vertices of one pair of bodies, P(7) and P(8): branch and bound over two vertex trees at once, by one warp or
// by several that share one stack.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/shape_headers.cuh"
#include "gpu/stages/vertices/search_stack.cuh"

namespace broadside::gpu {

// The near pairs among the 64 pairs of children of two nodes that a warp opened. A lane has two of them, with the same
// child of B.
class NearChildren {
 public:
  NearChildren() = default;
  // Called by the whole warp.
  __device__ NearChildren(const NodePair& first, const NodePair& second, bool is_first_near, bool is_second_near)
      : first_(first),
        second_(second),
        first_near_(__ballot_sync(kFullWarp, is_first_near)),
        second_near_(__ballot_sync(kFullWarp, is_second_near)) {}

  // The same in all lanes.
  __device__ std::uint32_t count() const { return __popc(first_near_) + __popc(second_near_); }
  __device__ bool are_any() const { return (first_near_ | second_near_) != 0; }
  __device__ bool are_leaves() const { return first_.are_leaves(); }

  // Calls put(place, pair) for this lane's near pairs; places are counted over all lanes.
  template <typename Put>
  __device__ void each(const Put& put) const {
    if (is_first_near()) put(first_place(), first_);
    if (is_second_near()) put(second_place(), second_);
  }

 private:
  __device__ static unsigned lanes_before() { return (1U << lane()) - 1U; }
  __device__ bool is_first_near() const { return (first_near_ >> lane() & 1U) != 0; }
  __device__ bool is_second_near() const { return (second_near_ >> lane() & 1U) != 0; }
  __device__ std::uint32_t first_place() const { return __popc(first_near_ & lanes_before()); }
  __device__ std::uint32_t second_place() const { return __popc(first_near_) + __popc(second_near_ & lanes_before()); }

  NodePair first_;
  NodePair second_;
  unsigned first_near_ = 0;  // bit k: the first pair of lane k is near
  unsigned second_near_ = 0;
};

// The two trees of a pair, and the nearest vertices that this lane has found. `bound`, in shared memory, has the bits
// of the smallest squared distance that any lane found (bits of non-negative floats have the order of their values).
class TreePair {
 public:
  __device__ TreePair(const FrameView& f, const ShapeHeaders& headers, const PlacedPair& bodies, std::uint32_t* bound)
      : nodes_(f.shapes.tree_nodes),
        vertices_(f.shapes.tree_vertices),
        a_(headers.trees[bodies.i.shape], headers.upper),
        b_(headers.trees[bodies.j.shape], headers.upper),
        xa_(bodies.i.x),
        xb_(bodies.j.x),
        bound_(bound) {
    const float theta_m = core::pair_theta_m(f.parameters, headers.trees[bodies.i.shape].mean_edge_m,
                                             headers.trees[bodies.j.shape].mean_edge_m);
    theta2_ = theta_m * theta_m;
  }

  __device__ NodePair roots() const { return {a_.root, b_.root, 0.0F}; }
  __device__ std::uint32_t top() const { return max(level_of(a_.root), level_of(b_.root)); }
  __device__ float limit() const { return __uint_as_float(*static_cast<volatile std::uint32_t*>(bound_)); }
  // The nearest vertices that this lane has found.
  __device__ core::Proximity best() const { return best_; }

  // The number of a body's upper nodes, and the k-th of them; the root follows them.
  __device__ std::uint32_t upper_count(bool of_a) const { return of_a ? a_.upper_count : b_.upper_count; }
  __device__ FetchedNode upper(bool of_a, std::uint32_t k) const {
    FetchedNode node = fetched_node((of_a ? a_.upper : b_.upper) + k);
    node.box = core::translated(node.box, of_a ? xa_ : xb_);
    return node;
  }
  __device__ bool is_near(float gap2) const { return gap2 < theta2_; }
  // How many levels there are below these nodes.
  __device__ std::uint32_t upper_level() const { return max(a_.upper_level, b_.upper_level); }

  // Called by the whole warp: opens both nodes, but a leaf stays as it is. All boxes are loaded before any is used, so
  // that the warp waits once.
  __device__ NearChildren open(const NodePair& parents, float limit) const {
    const bool opens_a = level_of(parents.a) != 0;
    const bool opens_b = level_of(parents.b) != 0;
    const std::uint32_t p = lane() / 8;
    const std::uint32_t q = lane() % 8;
    // If a node is a leaf, all lanes load its box, and only the first of them uses it.
    const auto place = [](bool opens, std::uint32_t word, std::uint32_t child, std::uint32_t leaf_offset) {
      return opens ? block_of(word) * kFanOut + child : word + leaf_offset;
    };
    FetchedNode low = fetched_node(nodes_ + place(opens_a, parents.a, p, a_.leaf_offset));
    FetchedNode high = fetched_node(nodes_ + place(opens_a, parents.a, p + 4, a_.leaf_offset));
    FetchedNode of_b = fetched_node(nodes_ + place(opens_b, parents.b, q, b_.leaf_offset));
    group_loads();
    low.box = core::translated(low.box, xa_);
    high.box = core::translated(high.box, xa_);
    of_b.box = core::translated(of_b.box, xb_);
    const float low_gap2 = squared_gap(low.box, of_b.box);
    const float high_gap2 = squared_gap(high.box, of_b.box);
    const auto is_near = [&](float gap2) { return gap2 < theta2_ && gap2 <= limit; };
    const bool takes_b = opens_b || q == 0;
    return {{low.word, of_b.word, low_gap2},
            {high.word, of_b.word, high_gap2},
            (opens_a || p == 0) && takes_b && is_near(low_gap2),
            opens_a && takes_b && is_near(high_gap2)};
  }

  // Called by the whole warp for up to four pairs of leaves, with eight lanes for each pair: a lane compares one vertex
  // of A with eight of B. kAtOnce of the eight are loaded at once, because waiting for loads is what takes the time.
  template <std::uint32_t kAtOnce>
  __device__ void visit_leaves(bool has_leaves, const NodePair& leaves, float limit) {
    static_assert(kLeafVertices % kAtOnce == 0);
    const bool is_near = has_leaves && leaves.gap2 <= limit;
    // The word of a leaf is the number of its block of vertices. A lane without a pair of leaves loads the first
    // vertices and ignores them.
    const PackedVec3* of_b = vertices_ + (is_near ? leaves.b * kLeafVertices : 0U);
    const PackedVec3 mine = fetched(vertices_ + (is_near ? leaves.a * kLeafVertices : 0U) + lane() % 8);
    const core::Vec3 va = mine.v + xa_;
    core::Proximity nearest{INFINITY, __float_as_uint(mine.w), 0};
#pragma unroll
    for (std::uint32_t first = 0; first < kLeafVertices; first += kAtOnce) {
      PackedVec3 others[kAtOnce];
#pragma unroll
      for (std::uint32_t t = 0; t < kAtOnce; ++t) others[t] = fetched(of_b + first + t);
      group_loads();
#pragma unroll
      for (std::uint32_t t = 0; t < kAtOnce; ++t) {
        const float d2 = core::squared_distance(va, others[t].v + xb_);
        const std::uint32_t other = __float_as_uint(others[t].w);
        if (d2 < nearest.squared_distance_m2 || (d2 == nearest.squared_distance_m2 && other < nearest.vertex_b)) {
          nearest.squared_distance_m2 = d2;
          nearest.vertex_b = other;
        }
      }
    }
    if (is_near && nearest.squared_distance_m2 < theta2_ && core::is_nearer(nearest, best_)) best_ = nearest;
    const std::uint32_t least = warp_min(__float_as_uint(best_.squared_distance_m2));
    if (lane() == 0 && least < *static_cast<volatile std::uint32_t*>(bound_)) atomicMin(bound_, least);
    __syncwarp();
  }

 private:
  // The fields of a tree that a search needs often. They are loaded once, because headers lie in global or shared
  // memory.
  struct Tree {
    __device__ Tree(const TreeHeader& header, const PackedBox* all_upper)
        : root(header.root),
          leaf_offset(header.leaf_offset),
          upper(all_upper + header.upper_begin),
          upper_count(header.upper_count),
          upper_level(header.upper_level) {}

    std::uint32_t root;
    std::uint32_t leaf_offset;
    const PackedBox* upper;
    std::uint32_t upper_count;
    std::uint32_t upper_level;
  };

  const PackedBox* nodes_;
  const PackedVec3* vertices_;
  Tree a_;
  Tree b_;
  core::Vec3 xa_;
  core::Vec3 xb_;
  std::uint32_t* bound_;
  float theta2_ = 0.0F;
  core::Proximity best_;
};

// By one warp, with a stack of its own. Returns each lane's nearest vertices.
__device__ inline core::Proximity nearest_by_trees(TreePair trees, const SearchStack& stack) {
  if (lane() == 0) stack.put(0, trees.roots());
  std::uint32_t size = 1;
  __syncwarp();
  while (size > 0) {
    const float limit = trees.limit();
    // Four groups of eight lanes look at the topmost four entries. If the topmost are pairs of leaves, they are visited
    // together.
    const std::uint32_t group = lane() / 8;
    const NodePair one = stack.at(size - 1 - min(group, size - 1));
    const unsigned are_leaves = __ballot_sync(kFullWarp, group < size && one.are_leaves());
    if ((are_leaves & 1U) != 0) {
      const std::uint32_t taken =
          are_leaves == kFullWarp ? 4U : static_cast<std::uint32_t>(__ffs(~are_leaves) - 1) / 8U;
      size -= taken;
      trees.visit_leaves<4>(group < taken, one, limit);
      continue;
    }
    const NodePair parents = stack.at(size - 1);
    --size;
    __syncwarp();
    if (parents.gap2 > limit) continue;
    const NearChildren near = trees.open(parents, limit);
    near.each([&](std::uint32_t place, const NodePair& pair) { stack.put(size + place, pair); });
    size += near.count();
    __syncwarp();
  }
  return trees.best();
}

// Whether there is enough to hand over: four pairs of nodes, each of which may become many, or as many pairs of leaves
// as sixteen warps visit in a round; or a mix of both.
__device__ inline bool is_much(const TeamCounts& left) {
  constexpr std::uint32_t kNodes = 4;
  constexpr std::uint32_t kLeaves = 64;
  return left.nodes * kLeaves + left.leaves * kNodes >= kNodes * kLeaves;
}

// Several warps of a block that search one pair.
struct SearchTeam : WarpShare {  // two or more warps
  std::uint32_t barrier = 0;     // the team's number in its block
  SearchStack stack;             // one for all members together
  // [kTeamTurns] how many pairs of nodes and of leaves a round adds. In shared memory. The second must be zero when a
  // search begins with what the stack holds.
  TeamCounts* counts = nullptr;

  __device__ void sync() const { sync_warps(barrier, members); }
  // The stack is divided in two. That of leaves needs 64 entries a warp, since a round makes no more pairs of leaves.
  __device__ SearchStack nodes() const { return stack.first(stack.entries - 64 * members); }
  __device__ SearchStack leaves() const { return stack.from(stack.entries - 64 * members); }
  // Entry k of a stack that holds `of`, where pairs of nodes come first, then pairs of leaves.
  __device__ void put(const TeamCounts& of, std::uint32_t k, const NodePair& p) const {
    k < of.nodes ? nodes().put(k, p) : leaves().put(k - of.nodes, p);
  }
  __device__ NodePair at(const TeamCounts& of, std::uint32_t k) const {
    return k < of.nodes ? nodes().at(k) : leaves().at(k - of.nodes);
  }
};

// Rounds add to these counts in turn; each is cleared in the round before the one that adds to it.
constexpr std::uint32_t kTeamTurns = 4;

// Called by one warp of a team: reserves room for its near pairs among all that this round adds. The first lane gets
// the place; the warp waits for it only where it is used.
__device__ inline std::uint32_t room_for_near(const NearChildren& near, TeamCounts& added) {
  std::uint32_t room = 0;
  if (near.are_any() && lane() == 0) room = atomicAdd(near.are_leaves() ? &added.leaves : &added.nodes, near.count());
  return room;
}
// Puts the near pairs there, after what is kept.
__device__ inline void put_for_team(const SearchTeam& team, const NearChildren& near, const TeamCounts& kept,
                                    std::uint32_t room) {
  if (!near.are_any()) return;
  const std::uint32_t first = __shfl_sync(kFullWarp, room, 0) + (near.are_leaves() ? kept.leaves : kept.nodes);
  const SearchStack stack = near.are_leaves() ? team.leaves() : team.nodes();
  near.each([&](std::uint32_t place, const NodePair& pair) { stack.put(first + place, pair); });
}

// By all warps of a team, in rounds. In a round each warp opens a pair of nodes or visits four pairs of leaves, from
// the top of the stack on. If surfaces touch, nearly all the work is below one pair of upper nodes, so it cannot be
// dealt out beforehand.
//
// `left`: what the stack holds. `leftover`: a LeftoverOfPair or NoLeftover (leftover_work.cuh). Returns each lane's
// nearest vertices.
template <typename Leftover>
__device__ core::Proximity nearest_by_trees(TreePair trees, const SearchTeam& team, TeamCounts left,
                                            Leftover& leftover) {
  const SearchStack nodes = team.nodes();
  const SearchStack leaves = team.leaves();
  // One warp alone that opens one pair after another never adds more than this. Each further pair that is opened at the
  // same time may add 63; the code divides by 64 because that is faster.
  const std::uint32_t reserve = 63 * trees.top();
  for (std::uint32_t round = 1; left.any(); ++round) {
    // All members compute the same division of work from `left`, so they need not communicate.
    const std::uint32_t groups = min(team.members, left.nodes > 0 ? left.leaves / 4 : (left.leaves + 3) / 4);
    const std::uint32_t visited = min(4 * groups, left.leaves);
    std::uint32_t opened = min(min(team.members - groups, left.nodes), (leaves.entries - (left.leaves - visited)) / 64);
    const std::uint32_t spare = nodes.entries > reserve + left.nodes ? (nodes.entries - reserve - left.nodes) / 64 : 0U;
    opened = min(opened, max(spare, 1U));
    const bool visits = team.member < groups;
    const bool opens = !visits && team.member - groups < opened;
    const std::uint32_t leaf = 4 * team.member + lane() / 8;
    NodePair own;
    if (visits && leaf < visited) own = leaves.at(left.leaves - 1 - leaf);
    if (opens) own = nodes.at(left.nodes - 1 - (team.member - groups));
    TeamCounts& added = team.counts[round % kTeamTurns];
    if (team.member == 0 && lane() == 0) team.counts[(round + 1) % kTeamTurns] = {};
    const float limit = trees.limit();
    NearChildren near;
    if (visits) trees.visit_leaves<kLeafVertices>(leaf < visited, own, limit);
    if (opens && own.gap2 <= limit) near = trees.open(own, limit);
    const std::uint32_t room = room_for_near(near, added);
    // After this barrier all members have read their entries, and the stack may be written.
    team.sync();
    const TeamCounts kept{left.nodes - opened, left.leaves - visited};
    put_for_team(team, near, kept, room);
    team.sync();
    left = {kept.nodes + added.nodes, kept.leaves + added.leaves};
    if (leftover.is_asked_after(round) && is_much(left) && leftover.hand_over(team, left, trees.limit())) break;
  }
  return trees.best();
}

}  // namespace broadside::gpu
