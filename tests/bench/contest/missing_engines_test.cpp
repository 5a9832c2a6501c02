#include "bench/contest/missing_engines.hpp"

#include <gtest/gtest.h>

namespace broadside::bench::contest {
namespace {

// Two entrants of one package, one that is here, and one whose library is no package of npm.
const std::vector<Entrant> kEntrants{{"jolt", "not installed: broadside fetch-engine jolt"},
                                     {"jolt[gyroscopic=1]", "not installed: broadside fetch-engine jolt"},
                                     {"rapier", ""},
                                     {"cannon", "not installed: broadside fetch-engine cannon"},
                                     {"dart-world", "built without DART"}};
const std::vector<std::string> kIds{"cannon", "jolt", "rapier"};

TEST(MissingEngines, AreNamedOnce) {
  EXPECT_EQ(missing_of(kEntrants, kIds), (std::vector<std::string>{"jolt", "cannon"}));
}

TEST(MissingEngines, AreInstalledWhereSomebodyAgrees) {
  std::string asked;
  std::vector<std::string> installed;
  const InstallPath path{kIds,
                         [&](const std::string& question) {
                           asked = question;
                           return true;
                         },
                         [&](std::string_view id) -> core::Status {
                           if (id == "cannon") return core::Error{"no network", "cannon", "try again"};
                           installed.emplace_back(id);
                           return core::Done{};
                         }};
  EXPECT_EQ(install_missing(kEntrants, path), 1U);
  EXPECT_NE(asked.find("jolt, cannon"), std::string::npos) << asked;
  EXPECT_EQ(installed, std::vector<std::string>{"jolt"});
}

TEST(MissingEngines, NothingIsInstalledUnasked) {
  std::size_t installed = 0;
  const auto install = [&](std::string_view) -> core::Status {
    ++installed;
    return core::Done{};
  };
  EXPECT_EQ(install_missing(kEntrants, {kIds, [](const std::string&) { return false; }, install}), 0U);
  EXPECT_EQ(installed, 0U);
  // The user is not asked where nothing is missing.
  EXPECT_EQ(install_missing({{"rapier", ""}}, {kIds, [](const std::string&) -> bool { throw "asked"; }, install}), 0U);
}

}  // namespace
}  // namespace broadside::bench::contest
