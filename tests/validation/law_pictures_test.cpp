// Every law has a picture on the page, and every picture belongs to a law that exists.
#include "reports/law_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "validation/judge.hpp"

namespace broadside::tests {
namespace {

TEST(LawPictures, EveryLawHasOneOfItsOwn) {
  std::set<std::string> drawn;
  for (const validation::ValidatorRow& row : validation::validators()) {
    const std::string picture = reports::law_picture(row.name);
    EXPECT_NE(picture, "") << "reports/law_pictures_*.cpp have no picture of " << row.name;
    EXPECT_TRUE(drawn.insert(picture).second) << row.name << " has the picture of another law";
    EXPECT_NE(row.law, "") << row.name;
  }
}

TEST(LawPictures, EveryPictureIsOfALaw) {
  for (const auto& pictures : {reports::pictures_of_traces(), reports::pictures_of_the_method(),
                               reports::pictures_of_motion(), reports::pictures_of_contacts()})
    for (const reports::LawPicture& picture : pictures)
      EXPECT_TRUE(std::any_of(validation::validators().begin(), validation::validators().end(),
                              [&](const validation::ValidatorRow& row) { return row.name == picture.law; }))
          << picture.law;
}

}  // namespace
}  // namespace broadside::tests
