// The coloring: contacts of one color share no dynamic body, and color by color is the order of the priorities.
#include "reference/octree_cpu/coloring.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/method/coloring.hpp"

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
  // In a chain, a contact waits for neighbors of lower priority in a row. The longest rising or falling run in a
  // thousand random numbers is seven or so long; the chance of a run of fifteen is one in 15!.
  EXPECT_GE(coloring.color_count(), 4U);
  EXPECT_LE(coloring.color_count(), 15U);
}

// Applied color by color, every body meets its contacts in the order of their priorities.
TEST(Coloring, IsTheOrderOfPriorities) {
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i < 60; ++i)
    for (std::uint32_t j = i + 1; j < 60; j += 1 + i % 5) pairs.push_back({i, j});
  Coloring coloring;
  coloring.color(pairs, std::vector<std::uint8_t>(60));
  expect_proper(coloring, pairs, std::vector<std::uint8_t>(60));
  std::vector<std::uint64_t> last(60, 0);
  for (const std::uint32_t k : coloring.order()) {
    const std::uint64_t priority = core::color_priority(pairs[k]);
    for (const std::uint32_t body : {pairs[k].i, pairs[k].j}) {
      EXPECT_GE(priority, last[body]) << "body " << body;
      last[body] = priority;
    }
  }
}

TEST(Coloring, BodyInThreeHundredContactsNeedsThreeHundredColors) {
  std::vector<core::Pair> pairs;
  for (std::uint32_t j = 1; j <= 300; ++j) pairs.push_back({0, j});
  std::vector<std::uint8_t> never_written(301);
  Coloring coloring;
  coloring.color(pairs, never_written);
  expect_proper(coloring, pairs, never_written);
  EXPECT_EQ(coloring.color_count(), 300U);
  // The same body as a static one is never written, so nothing conflicts.
  never_written[0] = 1;
  coloring.color(pairs, never_written);
  EXPECT_EQ(coloring.color_count(), 1U);
}

}  // namespace
}  // namespace broadside::reference
