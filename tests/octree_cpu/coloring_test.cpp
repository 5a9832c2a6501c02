// The coloring: contacts of one color share no dynamic body, and the order is the greedy one.
#include "reference/octree_cpu/coloring.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace broadside::reference {
namespace {

void expect_proper(const Coloring& coloring, const std::vector<core::Pair>& pairs,
                   const std::vector<std::uint8_t>& never_written) {
  ASSERT_EQ(coloring.order().size(), pairs.size());
  std::set<std::uint32_t> all(coloring.order().begin(), coloring.order().end());
  EXPECT_EQ(all.size(), pairs.size());
  for (std::uint32_t c = 0; c < coloring.color_count(); ++c) {
    std::set<std::uint32_t> seen;
    for (std::uint32_t k = coloring.color_begin()[c]; k < coloring.color_begin()[c + 1]; ++k) {
      const core::Pair p = pairs[coloring.order()[k]];
      for (const std::uint32_t body : {p.i, p.j}) {
        if (never_written[body] != 0) continue;
        EXPECT_TRUE(seen.insert(body).second) << "color " << c << " body " << body;
      }
    }
  }
}

TEST(Coloring, NoContactsNoColors) {
  Coloring coloring;
  coloring.color({}, std::vector<std::uint8_t>(4));
  EXPECT_EQ(coloring.color_count(), 0U);
}

TEST(Coloring, ChainOfContacts) {
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i + 1 < 1000; ++i) pairs.push_back({i, i + 1});
  const std::vector<std::uint8_t> never_written(1000);
  Coloring coloring;
  coloring.color(pairs, never_written);
  expect_proper(coloring, pairs, never_written);
  // A contact of a chain has two neighbors, so greedy needs at most three colors.
  EXPECT_LE(coloring.color_count(), 3U);
}

TEST(Coloring, BodyInThreeHundredContactsNeedsThreeHundredColors) {
  std::vector<core::Pair> pairs;
  for (std::uint32_t j = 1; j <= 300; ++j) pairs.push_back({0, j});
  std::vector<std::uint8_t> never_written(301);
  Coloring coloring;
  coloring.color(pairs, never_written);
  expect_proper(coloring, pairs, never_written);
  EXPECT_EQ(coloring.color_count(), 300U);
  // The same body, static, is never written: nothing conflicts.
  never_written[0] = 1;
  coloring.color(pairs, never_written);
  EXPECT_EQ(coloring.color_count(), 1U);
}

}  // namespace
}  // namespace broadside::reference
