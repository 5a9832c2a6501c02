// The suggestion for a name that is not known.
#include "core/nearest_name.hpp"

#include <gtest/gtest.h>

namespace broadside::core {
namespace {

TEST(NearestName, IsProposedWhereAThirdOfTheLettersAreWrongAndNoMore) {
  const std::vector<std::string_view> known{"octree", "brute", "hash"};
  EXPECT_EQ(advise_name("octere", known), "did you mean 'octree'?") << "two neighbors exchanged";
  EXPECT_EQ(advise_name("hsah", known), "did you mean 'hash'?") << "one exchange in four letters";
  EXPECT_EQ(advise_name("octrrr", known), "did you mean 'octree'?") << "two letters of six";
  EXPECT_EQ(advise_name("octxyz", known), "one of: octree brute hash") << "three letters of six";
  EXPECT_EQ(advise_name("", known), "one of: octree brute hash");
}

TEST(NearestName, OfMoreNamesThanALineHoldsTheCommandThatListsThemIsSaid) {
  std::vector<std::string> names;
  for (int k = 0; k < 17; ++k) names.push_back("engine-" + std::to_string(k));
  const std::vector<std::string_view> known(names.begin(), names.end());
  EXPECT_EQ(advise_name("nonsense", known, "broadside list engines"), "'broadside list engines' shows them");
  EXPECT_EQ(advise_name("enigne-7", known, "broadside list engines"), "did you mean 'engine-7'?");
  EXPECT_EQ(advise_name("nonsense", std::vector(known.begin(), known.begin() + 2), "broadside list engines"),
            "one of: engine-0 engine-1");
  EXPECT_EQ(advise_name("nonsense", known).find("one of: engine-0 engine-1 "), 0U) << "where no command lists them";
}

TEST(NearestName, OfPartsTheFirstOneSaysWhichKindIsMeant) {
  std::vector<std::string> names{"freefall:bunny:50", "rigid:stack:5", "rigid:sphere:slip-to-roll"};
  for (int k = 0; k < 14; ++k) names.push_back("tower:cube:" + std::to_string(k));
  const std::vector<std::string_view> known(names.begin(), names.end());
  EXPECT_EQ(advise_name("frefall:armadillo:5", known, "broadside list scenes"),
            "did you mean one like 'freefall:bunny:50'? 'broadside list scenes' shows them");
  EXPECT_EQ(advise_name("rigid:sphere:bounce", known, "broadside list scenes"),
            "did you mean one like 'rigid:sphere:slip-to-roll'? 'broadside list scenes' shows them");
  EXPECT_EQ(advise_name("nonsense:cube:5", known, "broadside list scenes"), "'broadside list scenes' shows them");
}

}  // namespace
}  // namespace broadside::core
