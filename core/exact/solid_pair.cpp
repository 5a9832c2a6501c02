// Convex solids: one pair of parts, measured in closed form.
#include <algorithm>

#include "core/exact/moving_pair.hpp"
#include "core/exact/plane_advance.hpp"

namespace broadside::exact {
namespace {

// Polytopes certainly overlap when the least depth is above this share of their sizes. The search for the least depth
// leaves out directions closer to parallel than 1e-9 (convex_core.cpp), which is a tenth of this.
constexpr double kSurelyDeep = 1e-8;

class SolidPair final : public MovingPair {
 public:
  SolidPair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b, const RigidMotion& motion_b)
      : a_(*a.parts().solid),
        b_(*b.parts().solid),
        motion_a_(motion_a),
        motion_b_(motion_b),
        reach_a_(a.reach_m()),
        reach_b_(b.reach_m()) {
    rounding_m_ = placing_error_m(motion_a, reach_a_) + placing_error_m(motion_b, reach_b_);
  }

  Parting parting_at(double time) override {
    const Placed now = place(time);
    const MovingPoints a{now.a.vertices, now.at_a.origin, motion_a_.displacement_m, motion_a_.rotation_rad, reach_a_};
    const MovingPoints b{now.b.vertices, now.at_b.origin, motion_b_.displacement_m, motion_b_.rotation_rad, reach_b_};
    const double radii = a_.radius_m + b_.radius_m;
    Point normal = signed_distance(now.a, now.b).normal;
    const Axis axis = widest_gap(now.a, now.b);
    const double of_nearest = gap_along(a, b, normal);
    if (axis.gap > of_nearest) normal = axis.direction;
    const double gap = std::max(axis.gap, of_nearest) - radii;
    // The normal is assumed to keep turning at the rate since the last measurement.
    Point turn;
    if (has_normal_ && time > time_before_) turn = (1.0 / (time - time_before_)) * cross(normal_before_, normal);
    has_normal_ = true;
    normal_before_ = normal;
    time_before_ = time;
    return {parted_until_by_any(a, b, normal, turn, radii + rounding_m_, time), gap};
  }

  bool overlap_at(double time) override {
    const Placed now = place(time);
    const bool is_flat_sided = !a_.faces.empty() || !b_.faces.empty();
    const double surely = rounding_m_ + (is_flat_sided ? kSurelyDeep * (reach_a_ + reach_b_) : 0.0);
    return signed_distance(now.a, now.b).distance_m < -surely;
  }

 private:
  struct Placed {
    Placement at_a, at_b;
    ConvexCore a, b;
  };

  [[nodiscard]] Placed place(double time) const {
    Placed out{placement_at(motion_a_, time), placement_at(motion_b_, time), {}, {}};
    out.a = placed(a_, out.at_a);
    out.b = placed(b_, out.at_b);
    return out;
  }

  const ConvexCore& a_;
  const ConvexCore& b_;
  RigidMotion motion_a_;
  RigidMotion motion_b_;
  double reach_a_;
  double reach_b_;
  double rounding_m_ = 0.0;
  bool has_normal_ = false;
  Point normal_before_;
  double time_before_ = 0.0;
};

}  // namespace

std::unique_ptr<MovingPair> solid_pair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                                       const RigidMotion& motion_b) {
  return std::make_unique<SolidPair>(a, motion_a, b, motion_b);
}

}  // namespace broadside::exact
