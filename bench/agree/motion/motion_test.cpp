#include "bench/agree/motion/motion_test.hpp"

#include "core/exact/feature_touch.hpp"

namespace broadside::bench {

std::span<const std::string_view> families_of(MotionKind kind) {
  if (is_of_features(kind)) return kFeatureFamilies;
  return kBodyFamilies;
}

MotionTruth truth_of(const continuous::MovingFeatures& features) {
  const exact::TouchTime found = exact::first_touch(features);
  return {found.touches ? MotionTruth::Kind::kTouch : MotionTruth::Kind::kApart, found.lower, found.upper, false};
}

double relative_speed_m(const MotionTest& test, double reach_a_m, double reach_b_m) {
  const exact::RigidMotion& a = test.a.motion;
  const exact::RigidMotion& b = test.b.motion;
  return length(a.displacement_m - b.displacement_m) + reach_a_m * length(a.rotation_rad) +
         reach_b_m * length(b.rotation_rad);
}

}  // namespace broadside::bench
