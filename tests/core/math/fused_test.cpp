#include "core/math/fused.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {
namespace {

TEST(Fused, AProductIsNotRoundedBeforeItIsAdded) {
  const float a = 1.0F + 0x1p-23F;
  EXPECT_EQ(plus_product(-1.0F - 0x1p-22F, a, a), 0x1p-46F);
  EXPECT_EQ(less_product(1.0F + 0x1p-22F, a, a), -0x1p-46F);
}

TEST(Fused, VectorsFollowTheirFormulas) {
  const Vec3 a{1.0F, 2.0F, 3.0F};
  const Vec3 b{-4.0F, 5.0F, 0.5F};
  EXPECT_EQ(plus_times(a, 2.0F, b), (Vec3{-7.0F, 12.0F, 4.0F}));
  EXPECT_EQ(less_times(a, 2.0F, b), (Vec3{9.0F, -8.0F, 2.0F}));
  EXPECT_EQ(fused_dot(a, b), 7.5F);
  EXPECT_EQ(plus_cross(a, a, b), (Vec3{1.0F - 14.0F, 2.0F - 12.5F, 3.0F + 13.0F}));
  const Symmetric3 m{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
  EXPECT_EQ(fused_product(m, a), (Vec3{1.0F + 8.0F + 15.0F, 4.0F + 4.0F + 18.0F, 5.0F + 12.0F + 9.0F}));
}

TEST(Fused, RootsAreOffByAFewOfTheirLastBits) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> exponent(-120.0, 120.0);
  double worst = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const auto x = static_cast<float>(std::exp2(exponent(engine)));
    const double root = std::sqrt(static_cast<double>(x));
    worst = std::max(worst, std::abs(reciprocal_root(x) * root - 1.0));
    worst = std::max(worst, std::abs(near_root(x) / root - 1.0));
    worst = std::max(worst, std::abs(near_reciprocal(x) * static_cast<double>(x) - 1.0) / 2.0);
  }
  EXPECT_LT(worst, 0x1p-22);
}

TEST(Fused, RootsOfNothingAndOfLittleAreFinite) {
  EXPECT_TRUE(std::isfinite(reciprocal_root(0.0F)));
  EXPECT_EQ(near_root(0.0F), 0.0F);
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_LE(reciprocal_root(least), 1.0 / std::sqrt(static_cast<double>(least)));
}

}  // namespace
}  // namespace broadside::core
