// Where the words of constraints lie in memory.
#include "gpu/stages/rigid/constraint_tiles.cuh"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <vector>

namespace broadside::gpu {
namespace {

constexpr std::uint64_t kPlaces = 70;  // the last tile is not full

class ConstraintTiles : public ::testing::TestWithParam<bool> {
 protected:
  ConstraintTiles() : words(constraint_words(kPlaces)), memory{words.data(), GetParam()} {}

  [[nodiscard]] std::ptrdiff_t index_of(std::uint64_t place, std::uint32_t word) const {
    return &TileSlot(memory, place).at(word) - words.data();
  }

  std::vector<PackedVec3> words;
  ConstraintMemory memory;
};

TEST_P(ConstraintTiles, NoTwoWordsLieAtOnePlace) {
  std::set<std::ptrdiff_t> taken;
  for (std::uint64_t place = 0; place < kPlaces; ++place)
    for (std::uint32_t word = 0; word < kConstraintWords; ++word) {
      const std::ptrdiff_t index = index_of(place, word);
      EXPECT_TRUE(taken.insert(index).second) << place << " " << word;
      EXPECT_GE(index, 0);
      EXPECT_LT(index, static_cast<std::ptrdiff_t>(words.size()));
    }
}

TEST_P(ConstraintTiles, WordsOfOneOrOfNeighborsLieSideBySide) {
  for (std::uint64_t place = 1; place < kTile; ++place)
    for (std::uint32_t word = 0; word + 1 < kConstraintWords; word += 2) {
      const std::ptrdiff_t index = index_of(place, word);
      if (GetParam()) {
        EXPECT_EQ(index_of(place, word + 1), index + 1);
        EXPECT_EQ(index % 2, 0) << "a pair is one transfer of 32 bytes";
      } else {
        EXPECT_EQ(index_of(place - 1, word), index - 1);
        EXPECT_EQ(index_of(place - 1, word + 1), index_of(place, word + 1) - 1);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(SingleWordsAndPairs, ConstraintTiles, ::testing::Bool());

}  // namespace
}  // namespace broadside::gpu
