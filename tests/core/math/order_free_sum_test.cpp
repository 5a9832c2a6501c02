#include "core/math/order_free_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace broadside::core {
namespace {

TEST(OrderFreeSum, IsTheSumToRoundingInEveryOrder) {
  std::mt19937_64 random(5);
  for (const float scale : {1e-44F, 1e-38F, 1e-20F, 1.0F, 1e20F, 1e33F}) {
    std::vector<float> terms;
    std::uniform_real_distribution<double> exponent(-12.0, 0.0);
    for (int k = 0; k < 10000; ++k)
      terms.push_back(static_cast<float>(static_cast<double>(scale) * std::pow(10.0, exponent(random))));
    double exact = 0.0;
    for (const float term : terms) exact += static_cast<double>(term);
    const float first = order_free_sum(terms);
    // Each term loses at most a 2^40th of the largest, and the result is rounded once.
    const double largest = static_cast<double>(*std::max_element(terms.begin(), terms.end()));
    EXPECT_NEAR(first, exact, 10000.0 * 0x1p-40 * std::max(largest, 0x1p-126) + exact * 0x1p-23 + 0x1p-149) << scale;
    for (int k = 0; k < 5; ++k) {
      std::shuffle(terms.begin(), terms.end(), random);
      EXPECT_EQ(order_free_sum(terms), first) << scale;
    }
  }
}

TEST(OrderFreeSum, OfZerosIsZero) {
  EXPECT_EQ(order_free_sum(std::vector<float>{0.0F, 0.0F}), 0.0F);
  EXPECT_EQ(order_free_sum({}), 0.0F);
}

}  // namespace
}  // namespace broadside::core
