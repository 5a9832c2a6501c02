// The search alone: every place of the change, with and without builds that cannot be judged.
#include "bench/bisect/first_changed.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

namespace broadside::tests {
namespace {

using bench::bisect::find_first_changed;
using bench::bisect::FirstChanged;
using bench::bisect::Look;

struct Searched {
  FirstChanged found;
  std::vector<std::size_t> asked;
};

// Builds from `change` on are changed; those of `unknown` cannot be judged.
Searched search_for(std::size_t count, std::size_t change, const std::set<std::size_t>& unknown) {
  Searched searched;
  const auto found = find_first_changed(count, [&](std::size_t k) -> core::Result<Look> {
    searched.asked.push_back(k);
    if (unknown.contains(k)) return Look::kUnknown;
    return k < change ? Look::kUnchanged : Look::kChanged;
  });
  EXPECT_TRUE(found);
  searched.found = found.value();
  return searched;
}

TEST(FirstChanged, IsFoundAtEveryPlaceByAskingLogarithmicallyOften) {
  for (std::size_t count = 2; count < 40; ++count)
    for (std::size_t change = 1; change < count; ++change) {
      const Searched s = search_for(count, change, {});
      EXPECT_EQ(s.found.first_changed, change);
      EXPECT_EQ(s.found.last_unchanged, change - 1);
      EXPECT_TRUE(s.found.unknown.empty());
      // Halving an interval of count-1 steps: ceil(log2).
      EXPECT_LE(s.asked.size(), static_cast<std::size_t>(std::bit_width(count - 1))) << count << " " << change;
    }
}

TEST(FirstChanged, BuildsThatCannotBeJudgedWidenTheAnswerAndNoMore) {
  constexpr std::size_t kCount = 9;
  for (unsigned mask = 0; mask < 128; ++mask) {  // any subset of builds 1 to 7
    std::set<std::size_t> unknown;
    for (std::size_t bit = 0; bit < 7; ++bit)
      if ((mask >> bit & 1U) != 0) unknown.insert(bit + 1);
    for (std::size_t change = 1; change < kCount; ++change) {
      const Searched s = search_for(kCount, change, unknown);
      // The expected answer, worked out here: the nearest builds on both sides that can be judged.
      std::size_t last = change - 1;
      while (unknown.contains(last)) --last;
      std::size_t first = change;
      while (unknown.contains(first)) ++first;
      EXPECT_EQ(s.found.last_unchanged, last) << mask << " " << change;
      EXPECT_EQ(s.found.first_changed, first) << mask << " " << change;
      EXPECT_EQ(s.found.unknown.size(), first - last - 1) << mask << " " << change;
      EXPECT_EQ(std::set<std::size_t>(s.asked.begin(), s.asked.end()).size(), s.asked.size())
          << "a build is asked once";
    }
  }
}

// Two hundred commits in a row do not compile, and the change is far from them: few of them are tried.
TEST(FirstChanged, LeavesABlockOfUnknownBuildsQuickly) {
  std::set<std::size_t> unknown;
  for (std::size_t k = 400; k < 600; ++k) unknown.insert(k);
  const Searched s = search_for(1000, 900, unknown);
  EXPECT_EQ(s.found.first_changed, 900U);
  EXPECT_TRUE(s.found.unknown.empty());
  EXPECT_LT(s.asked.size(), 20U);
}

TEST(FirstChanged, AnErrorEndsTheSearch) {
  const auto found = find_first_changed(9, [](std::size_t) -> core::Result<Look> {
    return core::Error{"interrupted", "", "", core::Exit::kMissing};
  });
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().exit, core::Exit::kMissing);
}

}  // namespace
}  // namespace broadside::tests
