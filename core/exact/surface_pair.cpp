// Surfaces of triangles: measures every pair of triangles whose separation may be the first to end, and skips the
// others by their balls.
#include <algorithm>
#include <array>
#include <vector>

#include "core/exact/moving_pair.hpp"
#include "core/exact/plane_advance.hpp"

namespace broadside::exact {
namespace {

// Triangles nearer than this share of their sizes are also separated along their normals and directions across their
// edges, because there the direction between nearest points consists of rounding.
constexpr double kClose = 1e-6;

class SurfacePair final : public MovingPair {
 public:
  SurfacePair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b, const RigidMotion& motion_b)
      : a_(a.parts().surface),
        b_(b.parts().surface),
        motion_a_(motion_a),
        motion_b_(motion_b),
        reach_a_(a.reach_m()),
        reach_b_(b.reach_m()) {
    rounding_m_ = placing_error_m(motion_a, reach_a_) + placing_error_m(motion_b, reach_b_);
    drift_m_ = length(motion_a.displacement_m - motion_b.displacement_m);
    spin_a_ = length(motion_a.rotation_rad);
    spin_b_ = length(motion_b.rotation_rad);
  }

  Parting parting_at(double time) override {
    place(time);
    Parting best;
    visit([&](const SphereTree::Node& a, const SphereTree::Node& b) { return balls_parted_until(a, b) < best.until; },
          [&](std::uint32_t i, std::uint32_t j) {
            const Parting found = triangles_part(placed_corners(a_, i, at_a_), placed_corners(b_, j, at_b_));
            if (found.until < best.until) best = found;
            return best.until > time_;
          });
    return best;
  }

  bool overlap_at(double time) override {
    place(time);
    bool meet = false;
    visit([&](const SphereTree::Node& a, const SphereTree::Node& b) { return gap_of_balls(a, b) <= 0.0; },
          [&](std::uint32_t i, std::uint32_t j) {
            const Corners a = placed_corners(a_, i, at_a_);
            const Corners b = placed_corners(b_, j, at_b_);
            meet = nearest_of_triangles(a, b).squared_m2 == 0.0;
            return !meet;
          });
    return meet;
  }

 private:
  void place(double time) {
    time_ = time;
    at_a_ = placement_at(motion_a_, time);
    at_b_ = placement_at(motion_b_, time);
  }

  static Corners placed_corners(const SphereTree& tree, std::uint32_t k, const Placement& at) {
    Corners out = tree.triangles[k];
    for (Point& p : out) p = at.turned(p) + at.origin;
    return out;
  }

  [[nodiscard]] double gap_of_balls(const SphereTree::Node& a, const SphereTree::Node& b) const {
    const Point between = at_a_.turned(a.center) + at_a_.origin - (at_b_.turned(b.center) + at_b_.origin);
    return length(between) - a.radius_m - b.radius_m - rounding_m_;
  }

  // Each ball's center moves no faster than its body's velocity and rotation together allow.
  [[nodiscard]] double balls_parted_until(const SphereTree::Node& a, const SphereTree::Node& b) const {
    const double gap = gap_of_balls(a, b);
    const double speed = drift_m_ + spin_a_ * length(a.center) + spin_b_ * length(b.center);
    if (!(gap > 0.0)) return time_;
    return gap > speed * (1.0 - time_) ? 2.0 : time_ + gap / speed;
  }

  Parting triangles_part(const Corners& a, const Corners& b) {
    const MovingPoints points_a{a, at_a_.origin, motion_a_.displacement_m, motion_a_.rotation_rad, reach_a_};
    const MovingPoints points_b{b, at_b_.origin, motion_b_.displacement_m, motion_b_.rotation_rad, reach_b_};
    const Nearest near = nearest_of_triangles(a, b);
    if (near.squared_m2 == 0.0) return {time_, 0.0};
    Point normal = near.on_a - near.on_b;
    const double distance = length(normal);
    normal = (1.0 / std::max(distance, 1e-300)) * normal;
    double gap = gap_along(points_a, points_b, normal);
    if (distance < kClose * (reach_a_ + reach_b_))
      for (const Point other : directions(a, b))
        for (const double side : {1.0, -1.0}) {
          const double along = gap_along(points_a, points_b, side * other);
          if (along > gap) {
            gap = along;
            normal = side * other;
          }
        }
    return {parted_until_by_any(points_a, points_b, normal, {}, rounding_m_, time_), gap};
  }

  // Unit vectors. For triangles in one plane they include the directions in that plane normal to each edge.
  static std::vector<Point> directions(const Corners& a, const Corners& b) {
    std::vector<Point> out;
    const auto add = [&](Point p) {
      if (length(p) > 0.0) out.push_back((1.0 / length(p)) * p);
    };
    for (const Corners* t : {&a, &b}) {
      const Point normal = cross((*t)[1] - (*t)[0], (*t)[2] - (*t)[0]);
      add(normal);
      for (int k = 0; k < 3; ++k) add(cross(normal, (*t)[(k + 1) % 3] - (*t)[k]));
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add(cross(a[(i + 1) % 3] - a[i], b[(j + 1) % 3] - b[j]));
    return out;
  }

  // Depth first; at(i, j) returns false to end the traversal.
  template <typename MayMatter, typename At>
  void visit(const MayMatter& may_matter, const At& at) const {
    if (a_.nodes.empty() || b_.nodes.empty()) return;
    std::vector<std::array<std::uint32_t, 2>> open{{0, 0}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      const SphereTree::Node& a = a_.nodes[i];
      const SphereTree::Node& b = b_.nodes[j];
      if (!may_matter(a, b)) continue;
      if (a.is_leaf && b.is_leaf) {
        if (!at(a.first, b.first)) return;
        continue;
      }
      // Open the larger node, and push its nearer child last, so that it is visited first.
      const bool opens_a = b.is_leaf || (!a.is_leaf && a.radius_m >= b.radius_m);
      std::array<std::uint32_t, 2> first{opens_a ? a.first : i, opens_a ? j : b.first};
      std::array<std::uint32_t, 2> second{opens_a ? a.first + 1 : i, opens_a ? j : b.first + 1};
      if (gap_of_balls(a_.nodes[first[0]], b_.nodes[first[1]]) < gap_of_balls(a_.nodes[second[0]], b_.nodes[second[1]]))
        std::swap(first, second);
      open.push_back(first);
      open.push_back(second);
    }
  }

  const SphereTree& a_;
  const SphereTree& b_;
  RigidMotion motion_a_;
  RigidMotion motion_b_;
  double reach_a_;
  double reach_b_;
  double rounding_m_ = 0.0;
  double drift_m_ = 0.0;
  double spin_a_ = 0.0;
  double spin_b_ = 0.0;
  double time_ = 0.0;
  Placement at_a_;
  Placement at_b_;
};

}  // namespace

std::unique_ptr<MovingPair> surface_pair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                                         const RigidMotion& motion_b) {
  return std::make_unique<SurfacePair>(a, motion_a, b, motion_b);
}

}  // namespace broadside::exact
