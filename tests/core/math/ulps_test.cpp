// Distances counted in representable numbers; expected values follow from the layout of numbers in IEEE 754.
#include "core/math/ulps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace broadside::tests {
namespace {

using core::kNoUlps;
using core::ulps_between;

template <typename Real>
class Ulps : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Ulps, Reals);

TYPED_TEST(Ulps, AreOneBetweenNeighborsOfAnySize) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr TypeParam kUp = Limits::infinity();
  for (const TypeParam v : {TypeParam(1), TypeParam(0), TypeParam(0.1), -TypeParam(3), Limits::denorm_min(),
                            Limits::min(), Limits::max(), Limits::lowest()}) {
    EXPECT_EQ(ulps_between(v, std::nextafter(v, kUp)), 1U) << v;
    EXPECT_EQ(ulps_between(std::nextafter(v, kUp), v), 1U) << v;
    EXPECT_EQ(ulps_between(v, v), 0U) << v;
  }
}

TYPED_TEST(Ulps, CountThroughZero) {
  constexpr TypeParam kTiny = std::numeric_limits<TypeParam>::denorm_min();
  EXPECT_EQ(ulps_between(TypeParam(0), -TypeParam(0)), 0U);
  EXPECT_EQ(ulps_between(-kTiny, kTiny), 2U);
  EXPECT_EQ(ulps_between(-3 * kTiny, 4 * kTiny), 7U);
}

// Between 1 and 2 there are 2^(digits - 1) steps.
TYPED_TEST(Ulps, AreAsManyAsTheSignificandHas) {
  constexpr int kDigits = std::numeric_limits<TypeParam>::digits;
  EXPECT_EQ(ulps_between(TypeParam(1), TypeParam(2)), std::uint64_t{1} << (kDigits - 1));
}

TYPED_TEST(Ulps, AreUndefinedForNaN) {
  constexpr TypeParam kNaN = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_EQ(ulps_between(kNaN, TypeParam(1)), kNoUlps);
  EXPECT_EQ(ulps_between(TypeParam(1), kNaN), kNoUlps);
  EXPECT_EQ(ulps_between(kNaN, kNaN), 0U);
  EXPECT_EQ(ulps_between(kNaN, -kNaN), kNoUlps);
}

}  // namespace
}  // namespace broadside::tests
