// The property for which Hilbert's order is used: it visits every cell once, and each step is to a neighboring cell.
#include "core/method/space_curve.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace broadside::tests {
namespace {

TEST(HilbertCode, VisitsEveryCellOnceStepByStep) {
  for (const int bits : {1, 2, 3, 5}) {
    const std::uint32_t side = 1U << static_cast<unsigned>(bits);
    std::vector<core::CurveCell> at(side * side * side);
    std::vector<int> visits(at.size(), 0);
    for (std::uint32_t z = 0; z < side; ++z)
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
          const std::uint32_t code = core::hilbert_code({x, y, z}, bits);
          ASSERT_LT(code, at.size());
          at[code] = {x, y, z};
          ++visits[code];
        }
    for (std::size_t code = 0; code < at.size(); ++code) {
      ASSERT_EQ(visits[code], 1) << "code " << code << ", " << bits << " bits";
      if (code == 0) continue;
      const auto step = [](std::uint32_t p, std::uint32_t q) { return p < q ? q - p : p - q; };
      ASSERT_EQ(step(at[code].x, at[code - 1].x) + step(at[code].y, at[code - 1].y) + step(at[code].z, at[code - 1].z),
                1U)
          << "code " << code << ", " << bits << " bits";
    }
  }
}

// Bits of x, y, z in turn, from the lowest: (1, 0, 0) is 1, (0, 1, 0) is 2, (0, 0, 1) is 4, (2, 0, 0) is 8.
TEST(MortonCode, InterleavesBits) {
  EXPECT_EQ(core::morton_code(1, 0, 0), 1U);
  EXPECT_EQ(core::morton_code(0, 1, 0), 2U);
  EXPECT_EQ(core::morton_code(0, 0, 1), 4U);
  EXPECT_EQ(core::morton_code(2, 0, 0), 8U);
  EXPECT_EQ(core::morton_code(1023, 1023, 1023), 0x3FFFFFFFU);
}

}  // namespace
}  // namespace broadside::tests
