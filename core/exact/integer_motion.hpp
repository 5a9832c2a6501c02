// Moving points whose coordinates were scaled to integers, all by one factor, which leaves times unchanged.
#pragma once

#include <gmpxx.h>

#include <array>

#include "core/exact/feature_touch.hpp"

namespace broadside::exact {

struct IntegerMotion {
  continuous::FeatureKind kind = continuous::FeatureKind::kVertexFace;
  std::array<std::array<mpz_class, 3>, 4> start;
  std::array<std::array<mpz_class, 3>, 4> end;
};

IntegerMotion integer_motion(const continuous::MovingFeatures& features);
core::Result<IntegerMotion> integer_motion(const RationalFeatures& features);

}  // namespace broadside::exact
