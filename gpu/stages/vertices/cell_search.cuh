// Nearest vertices of one pair of bodies of which one has cells of near vertices: vertices of the other body that may
// be near are looked up in these cells. P(7) and P(8).
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/shape_headers.cuh"
#include "gpu/stages/vertices/search_stack.cuh"

namespace broadside::gpu {

// Which body's vertices are looked up (it asks) in the cells of which (it answers). has_cells is false if neither shape
// has cells, or if bodies are so far from the origin that lists may be wrong.
struct CellRoles {
  bool has_cells = false;
  bool is_asked_by_j = false;
};

__device__ inline CellRoles cell_roles(const FrameView& f, const ShapeHeaders& headers, const PlacedPair& bodies) {
  const NearCells& of_i = headers.cells[bodies.i.shape];
  const NearCells& of_j = headers.cells[bodies.j.shape];
  const core::Vec3 xi = bodies.i.x;
  const core::Vec3 xj = bodies.j.x;
  const float far = f.shapes.extent_m + fmaxf(fmaxf(fmaxf(fabsf(xi.x), fabsf(xi.y)), fabsf(xi.z)),
                                              fmaxf(fmaxf(fabsf(xj.x), fabsf(xj.y)), fabsf(xj.z)));
  const bool i_answers = far <= of_i.range_m;
  const bool j_answers = far <= of_j.range_m;
  // If both can answer, the body with fewer vertices asks.
  const bool is_asked_by_j = i_answers && (!j_answers || headers.trees[bodies.j.shape].node_count[0] <
                                                             headers.trees[bodies.i.shape].node_count[0]);
  return {i_answers || j_answers, is_asked_by_j};
}

// A run is a node of kRunVertices vertices. A warp takes two runs at a time, and each lane two vertices of each. Shapes
// with cells have at most 128 runs.
constexpr std::uint32_t kRunLevel = 1;
constexpr std::uint32_t kRunVertices = kLeafVertices * kFanOut;
static_assert(kRunVertices == 64, "two a lane");

// As TreePair, with another way to find the nearest. Vertices of the asking body whose run's box is near the answering
// body's box are looked up in the answering body's cells. Vertices whose cell may have something near enough wait in a
// queue until there is one for each lane.
//
// `kLoadsAlways`: lanes without work load too, so that all loads of a warp are issued together and it waits once. In
// grid frames other warps hide that wait, and superfluous loads cost more than they save.
template <bool kLoadsAlways>
class NearestByCells {
 public:
  __device__ NearestByCells(const FrameView& f, const ShapeHeaders& headers, const PlacedPair& bodies,
                            bool is_asked_by_j, SearchStack stack, std::uint32_t* bound, const WarpShare& share)
      : f_(f),
        tree_(headers.trees[is_asked_by_j ? bodies.j.shape : bodies.i.shape]),
        other_tree_(headers.trees[is_asked_by_j ? bodies.i.shape : bodies.j.shape]),
        cells_(headers.cells[is_asked_by_j ? bodies.i.shape : bodies.j.shape]),
        vertices_(f.shapes.tree_vertices + tree_.vertex_begin),
        quantized_(f.shapes.quantized + tree_.vertex_begin),
        x_(is_asked_by_j ? bodies.j.x : bodies.i.x),
        other_x_(is_asked_by_j ? bodies.i.x : bodies.j.x),
        is_asked_by_j_(is_asked_by_j),
        queue_(stack),
        bound_(bound),
        share_(share) {
    const float theta_m = core::pair_theta_m(f.parameters, tree_.mean_edge_m, other_tree_.mean_edge_m);
    theta2_ = theta_m * theta_m;
    const core::Vec3 at = cells_.quanta_per_m * ((x_ - other_x_) - cells_.low);
    // Rounded up, because vertices are rounded down: so the sum is off by at most one quantum either way. An origin
    // that is clamped leaves all vertices outside the cells.
    const auto origin = [&](float place, std::uint32_t count) {
      const auto most = static_cast<int>(count << cells_.shift);
      return static_cast<std::uint32_t>(min(max(floor_to_int(place) + 1, -cells_.reach), most + cells_.reach)) &
             0xFFFFU;
    };
    origin_xy_ = origin(at.x, cells_.count_x) | origin(at.y, cells_.count_y) << 16U;
    origin_z_ = origin(at.z, cells_.count_z);
    most_xy_ = ((cells_.count_x << cells_.shift) - 1U) | ((cells_.count_y << cells_.shift) - 1U) << 16U;
    most_z_ = (cells_.count_z << cells_.shift) - 1U;
    shift_ = cells_.shift;
    stride_y_ = cells_.stride_y;
    stride_z_ = cells_.stride_z;
    lower_ = f.shapes.near_lower + cells_.first_lower;
    last_ = tree_.node_count[0] * kLeafVertices - 1;
  }

  // Returns each lane's nearest vertices.
  __device__ core::Proximity find() {
    // A tree without nodes of that level is itself one run, whose box is the root's.
    const std::uint32_t level = min(kRunLevel, tree_.top);
    const std::uint32_t runs = tree_.node_count[level];
    const PackedBox* root = f_.shapes.tree_nodes + other_tree_.node_begin[other_tree_.top];
    const PackedBox* boxes = f_.shapes.tree_nodes + tree_.node_begin[level];
    for (std::uint32_t first = share_.member; first < runs; first += 32 * share_.members) {
      const std::uint32_t run = first + lane() * share_.members;  // dealt out to the pair's warps
      const core::Box box = fetched(boxes + min(run, runs - 1));
      const core::Box other_box = fetched(root);
      group_loads();
      const float gap2 = squared_gap(core::translated(box, x_), core::translated(other_box, other_x_));
      const bool is_near = run < runs && gap2 < theta2_ && gap2 <= limit();
      for (unsigned left = __ballot_sync(kFullWarp, is_near); left != 0;) {
        const auto take = [&] {
          const auto taken = static_cast<std::uint32_t>(__ffs(static_cast<int>(left)) - 1);
          left &= left - 1;
          return first + taken * share_.members;
        };
        const std::uint32_t one = take();
        const bool are_two = left != 0;
        look_up(one, are_two, are_two ? take() : one);
        while (waiting_ >= 32) visit(32);
      }
    }
    if (waiting_ > 0) visit(waiting_);
    return best_;
  }

 private:
  __device__ float limit() const { return __uint_as_float(*static_cast<volatile std::uint32_t*>(bound_)); }

  // The cell that has a vertex at this place in quanta. Cells at the rim are empty, so vertices outside the cells may
  // count as being there.
  __device__ std::uint32_t cell_of(std::uint32_t xy, std::uint32_t z) const {
    const std::uint32_t at_xy = clamped_sums(xy, origin_xy_, most_xy_);
    const std::uint32_t at_z = clamped_sums(z, origin_z_, most_z_);
    return cell_index((at_xy & 0xFFFFU) >> shift_, at_xy >> 16U >> shift_, at_z >> shift_, stride_y_, stride_z_);
  }

  // Looks up two vertices a lane, of one run or of two. Neighboring lanes have neighboring vertices.
  __device__ void look_up(std::uint32_t one, bool are_two, std::uint32_t other) {
    const float now = limit();
    if (now != limit_) {
      limit_ = now;
      // The limit in whole steps, rounded up, and one more, because what the lists allow for rounding is less than a
      // step.
      const float steps = sqrtf(now) / cells_.lower_step_m;
      most_ = steps < 253.0F ? static_cast<std::uint32_t>(floor_to_int(steps)) + 1U : 254U;
    }
    std::uint32_t vertex[4];
    std::uint32_t cell[4];
    bool keeps[4];
    uint2 place[4];
#pragma unroll
    for (std::uint32_t k = 0; k < 4; ++k) {
      // The last run may be short: lanes past its end take its last vertex.
      vertex[k] = min((k < 2 ? one : other) * kRunVertices + k % 2 * 32 + lane(), last_);
      place[k] = *reinterpret_cast<const uint2*>(quantized_ + vertex[k]);
    }
    group_loads();
    std::uint32_t lower[4];
#pragma unroll
    for (std::uint32_t k = 0; k < 4; ++k) {
      cell[k] = cell_of(place[k].x, place[k].y);
      lower[k] = kLoadsAlways || k < 2 || are_two ? lower_[cell[k]] : 255U;
    }
    if constexpr (kLoadsAlways) group_loads();
#pragma unroll
    for (std::uint32_t k = 0; k < 4; ++k) keeps[k] = (k < 2 || are_two) && lower[k] <= most_;
#pragma unroll
    for (std::uint32_t k = 0; k < 4; ++k) {
      const unsigned kept = __ballot_sync(kFullWarp, keeps[k]);
      if (keeps[k]) {
        const std::uint32_t at = waiting_ + __popc(kept & ((1U << lane()) - 1U));
        queue_.a()[at] = vertex[k];
        queue_.b()[at] = cell[k];
      }
      waiting_ += __popc(kept);
    }
    __syncwarp();
  }

  __device__ void take(float d2, float own_id, float other_id) {
    const core::Proximity found{d2, __float_as_uint(is_asked_by_j_ ? other_id : own_id),
                                __float_as_uint(is_asked_by_j_ ? own_id : other_id)};
    if (d2 < theta2_ && core::is_nearer(found, best_)) best_ = found;
  }

  __device__ void visit_two(core::Vec3 v, float own_id, const PackedVec3& first, const PackedVec3& second) {
    const float first_d2 = core::squared_distance(v, first.v + other_x_);
    const float second_d2 = core::squared_distance(v, second.v + other_x_);
    const float least_d2 = fminf(first_d2, second_d2);
    if (!(least_d2 < theta2_) || least_d2 > best_.squared_distance_m2) return;
    take(first_d2, own_id, first.w);
    take(second_d2, own_id, second.w);
  }

  // Measures the last `count` of the waiting vertices, up to 32, against the lists of their cells. The fewer vertices
  // there are, the more lanes each gets, because waiting for the vertices that a list names is what takes the time.
  __device__ void visit(std::uint32_t count) {
    waiting_ -= count;
    const auto shift =
        static_cast<std::uint32_t>(__clz(static_cast<int>(count - 1))) - 27U;  // 32 / count, rounded down
    const std::uint32_t lanes = 1U << shift;
    const std::uint32_t own = lane() >> shift;
    // Lanes without a vertex of their own load the last one, and have no list.
    const std::uint32_t at = waiting_ + min(own, count - 1);
    const std::uint32_t cell = queue_.b()[at];
    const PackedVec3 mine = fetched(vertices_ + queue_.a()[at]);
    const NearList list = unpacked_list(f_.shapes.near_lists[cells_.first_list + cell]);
    group_loads();
    const core::Vec3 v = mine.v + x_;
    const NearEntry* entries = f_.shapes.near_entries + cells_.first_entry + list.begin;
    const PackedVec3* others = f_.shapes.tree_vertices + other_tree_.vertex_begin;
    const std::uint32_t length = own < count ? list.length : 0U;
    std::uint32_t step = lane() & (lanes - 1U);
    if constexpr (kLoadsAlways) {
      // The next entry of a list is loaded together with the vertices of this one.
      uint2 four = step < length ? *reinterpret_cast<const uint2*>(entries + step) : uint2{0, 0};
      while (__any_sync(kFullWarp, step < length)) {
        const bool has_four = step < length;
        const PackedVec3 first = fetched(others + (four.x & 0xFFFFU));
        const PackedVec3 second = fetched(others + (four.x >> 16U));
        const PackedVec3 third = fetched(others + (four.y & 0xFFFFU));
        const PackedVec3 fourth = fetched(others + (four.y >> 16U));
        step += lanes;
        if (step < length) four = *reinterpret_cast<const uint2*>(entries + step);
        group_loads();
        if (!has_four) continue;
        visit_two(v, mine.w, first, second);
        visit_two(v, mine.w, third, fourth);
      }
    } else {
      for (; step < length; step += lanes) {
        const uint2 four = *reinterpret_cast<const uint2*>(entries + step);
        visit_two(v, mine.w, fetched(others + (four.x & 0xFFFFU)), fetched(others + (four.x >> 16U)));
        visit_two(v, mine.w, fetched(others + (four.y & 0xFFFFU)), fetched(others + (four.y >> 16U)));
      }
    }
    const std::uint32_t least = warp_min(__float_as_uint(best_.squared_distance_m2));
    if (lane() == 0 && least < *static_cast<volatile std::uint32_t*>(bound_)) atomicMin(bound_, least);
    __syncwarp();
  }

  const FrameView& f_;
  const TreeHeader& tree_;
  const TreeHeader& other_tree_;
  const NearCells& cells_;
  const PackedVec3* vertices_;
  const QuantizedVertex* quantized_;
  core::Vec3 x_;
  core::Vec3 other_x_;
  // In quanta: the origin of the asking body's coordinates, and the last place of the cells.
  std::uint32_t origin_xy_ = 0;
  std::uint32_t origin_z_ = 0;
  std::uint32_t most_xy_ = 0;
  std::uint32_t most_z_ = 0;
  // Fields of the cells that are used again and again.
  std::uint32_t shift_ = 0;
  std::uint32_t stride_y_ = 0;
  std::uint32_t stride_z_ = 0;
  const std::uint8_t* lower_ = nullptr;
  std::uint32_t last_ = 0;  // the last vertex
  bool is_asked_by_j_;
  SearchStack queue_;
  std::uint32_t waiting_ = 0;  // vertices in the queue: below 32, and up to 128 more after a look-up
  std::uint32_t* bound_;
  WarpShare share_;
  float theta2_ = 0.0F;
  float limit_ = INFINITY;
  std::uint32_t most_ = 254;  // the largest `lower` that is near enough for limit_
  core::Proximity best_;
};

}  // namespace broadside::gpu
