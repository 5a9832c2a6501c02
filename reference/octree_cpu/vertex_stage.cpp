#include "reference/octree_cpu/vertex_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cstdint>

namespace broadside::reference {
namespace {

using core::Box;
using core::Proximity;
using core::Vec3;

// The largest gap between two boxes over the axes; negative when they overlap.
float axis_gap(const Box& a, const Box& b) {
  float gap = a.min.x - b.max.x;
  const auto widen = [&gap](float g) { gap = g > gap ? g : gap; };
  widen(b.min.x - a.max.x);
  widen(a.min.y - b.max.y);
  widen(b.min.y - a.max.y);
  widen(a.min.z - b.max.z);
  widen(b.min.z - a.max.z);
  return gap;
}

// Finds the nearest pair by branch and bound over the octree's leaves and the boxes within them. Every pair that is
// skipped is at least as far apart as the one that is kept, in the rounded arithmetic too (see apart_by), so the result
// is that of trying every pair of vertices.
class NearestVertices {
 public:
  NearestVertices(const ShapeData& a, Vec3 xa, const ShapeData& b, Vec3 xb, float theta_m)
      : a_(a), b_(b), xa_(xa), xb_(xb), theta_m_(theta_m), theta2_(theta_m * theta_m) {}

  Proximity find() {
    for (int p = 0; p < 8; ++p) {
      Box box_p;
      if (!world_box(a_, xa_, core::kLevelOffset[1] + p, box_p) || is_skipped(box_p, b_box())) continue;
      for (int q = 0; q < 8; ++q) {
        Box box_q;
        if (!world_box(b_, xb_, core::kLevelOffset[1] + q, box_q) || is_skipped(box_p, box_q)) continue;
        children(p, q, box_q);
      }
    }
    return best_;
  }

 private:
  static bool world_box(const ShapeData& s, Vec3 x, int node, Box& box) {
    const Box& local = s.shape.octree.boxes[node];
    if (core::is_empty(local)) return false;
    box = core::translated(local, x);
    return true;
  }

  [[nodiscard]] Box b_box() const { return core::translated(b_.boxes.root, xb_); }

  [[nodiscard]] bool is_skipped(const Box& p, const Box& q) const {
    const float gap = axis_gap(p, q);
    return gap >= theta_m_ || (gap > 0.0F && gap * gap > best_.squared_distance_m2);
  }

  void children(int p, int q, const Box& box_q) {
    for (int r = 8 * p; r < 8 * p + 8; ++r) {
      Box box_r;
      if (!world_box(a_, xa_, core::kLevelOffset[2] + r, box_r) || is_skipped(box_r, box_q)) continue;
      for (int s = 8 * q; s < 8 * q + 8; ++s) {
        Box box_s;
        if (!world_box(b_, xb_, core::kLevelOffset[2] + s, box_s) || is_skipped(box_r, box_s)) continue;
        blocks(a_.blocks.root[static_cast<std::size_t>(r)], box_r, b_.blocks.root[static_cast<std::size_t>(s)], box_s);
      }
    }
  }

  // Two nodes within leaves. The larger node is opened, so both shrink together.
  void blocks(std::uint32_t node_a, const Box& box_a, std::uint32_t node_b, const Box& box_b) {
    const VertexBlocks::Node& a = a_.blocks.nodes[node_a];
    const VertexBlocks::Node& b = b_.blocks.nodes[node_b];
    if (a.child == 0 && b.child == 0) {
      vertices(a, b, box_b);
      return;
    }
    const bool opens_a = b.child == 0 || (a.child != 0 && a.last - a.first >= b.last - b.first);
    for (std::uint32_t k = 0; k < 2; ++k) {
      if (opens_a) {
        const Box child = core::translated(a_.blocks.nodes[a.child + k].box, xa_);
        if (!is_skipped(child, box_b)) blocks(a.child + k, child, node_b, box_b);
      } else {
        const Box child = core::translated(b_.blocks.nodes[b.child + k].box, xb_);
        if (!is_skipped(box_a, child)) blocks(node_a, box_a, b.child + k, child);
      }
    }
  }

  void vertices(const VertexBlocks::Node& a, const VertexBlocks::Node& b, const Box& box_b) {
    for (std::uint32_t p = a.first; p < a.last; ++p) {
      const Vec3 v = a_.blocks.vertices[p] + xa_;
      if (is_skipped({v, v}, box_b)) continue;
      for (std::uint32_t q = b.first; q < b.last; ++q) {
        const float d2 = core::squared_distance(v, b_.blocks.vertices[q] + xb_);
        if (!(d2 < theta2_) || d2 > best_.squared_distance_m2) continue;
        const Proximity found{d2, a_.blocks.indices[p], b_.blocks.indices[q]};
        if (core::is_nearer(found, best_)) best_ = found;
      }
    }
  }

  const ShapeData& a_;
  const ShapeData& b_;
  Vec3 xa_;
  Vec3 xb_;
  float theta_m_;
  float theta2_;
  Proximity best_;
};

}  // namespace

void measure_proximity(const Bodies& bodies, const core::Parameters& parameters, std::span<const core::Pair> confirmed,
                       std::vector<Proximity>& out) {
  out.resize(confirmed.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, confirmed.size(), 4), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const auto [i, j] = confirmed[k];
      const ShapeData& a = bodies.shapes[bodies.shape[i]];
      const ShapeData& b = bodies.shapes[bodies.shape[j]];
      const float theta_m = core::pair_theta_m(parameters, a.shape, b.shape);
      out[k] = NearestVertices(a, bodies.state[i].x, b, bodies.state[j].x, theta_m).find();
    }
  });
}

}  // namespace broadside::reference
