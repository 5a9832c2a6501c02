#include "bench/contest/contest_request.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <string>

namespace broadside::bench::contest {
namespace {

TEST(ContestRequest, NamesAStepAsAPartOfASecondWhereItIsOne) {
  EXPECT_EQ(scene_at("rigid:bounce", 1.0 / 60.0, 1.0), "rigid:bounce");
  EXPECT_EQ(scene_at("rigid:bounce", 1.0 / 60.0, 0.5), "rigid:bounce@1/120");
  EXPECT_EQ(scene_at("rigid:bounce", static_cast<double>(1.0F / 60.0F), 0.25), "rigid:bounce@1/240");
  EXPECT_EQ(scene_at("rigid:bounce", 0.3, 2.0), "rigid:bounce@0.6");
}

TEST(ContestRequest, CellsAreScenesTimesEnginesTimesSteps) {
  ContestRequest request;
  request.engines = {"plain-rigid", "bullet-world"};
  request.scenes = {"two-body:head-on"};
  request.step_factors = {0.5, 1.0};
  const auto campaign = contest_campaign(request);
  ASSERT_TRUE(campaign) << campaign.error().line();
  ASSERT_EQ(campaign.value().cells.size(), 4U);
  EXPECT_EQ(campaign.value().cells[0].engine, "plain-rigid");
  EXPECT_EQ(campaign.value().cells[1].scene, "two-body:head-on");
  EXPECT_NE(campaign.value().cells[0].scene.find("two-body:head-on@"), std::string::npos);
}

// The whole contest has to fit into an hour: of the scenes that the user did not name, one of each kind runs at every
// step.
TEST(ContestRequest, WithoutScenesOneOfEachKindTakesEveryStep) {
  ContestRequest request;
  request.engines = {"plain-rigid"};
  const auto campaign = contest_campaign(request);
  ASSERT_TRUE(campaign) << campaign.error().line();
  const auto& cells = campaign.value().cells;
  const auto of = [&](std::string_view name) {
    return std::count_if(cells.begin(), cells.end(), [&](const auto& w) { return w.scene.starts_with(name); });
  };
  EXPECT_EQ(of("rigid:torque-free:box"), 4);
  EXPECT_EQ(of("rigid:slide:heading-3"), 4);
  EXPECT_EQ(of("rigid:slide:heading-5"), 1);
  // Scenes that must stand by statics, whose own step is 1/240 s, run at the usual 1/60 s too, also with the
  // recommended settings.
  const std::string_view kStand[] = {"rigid:incline:stick",    "rigid:tip:incline-stands", "rigid:tip:push-stands",
                                     "rigid:card-tent:stands", "rigid:overhang:stands",    "rigid:arch:7-stands",
                                     "rigid:arch:25-stands"};
  for (const std::string_view name : kStand) EXPECT_EQ(of(std::string(name) + "@1/60"), 1) << name;
  EXPECT_EQ(of("rigid:stack:20"), 1) << "1/60 s is its own step";
  EXPECT_EQ(of("rigid:arch:7-falls"), 1);
  // Each of the other steps, and the passages: 15 of fast scenes, 3 of them at a scene's own step, and 6 speeds.
  EXPECT_EQ(cells.size(), default_scenes().size() + 9 * 3 + std::size(kStand) + 12 + 6);
}

// Which engines of npm this machine has installed must not matter here: asking an engine for its description would
// start this test program as its child process.
class WithoutFetchedEngines {
 public:
  WithoutFetchedEngines() {
    if (const char* before = getenv(kName)) before_ = before;
    setenv(kName, "/nowhere", 1);
  }
  ~WithoutFetchedEngines() { before_.empty() ? unsetenv(kName) : setenv(kName, before_.c_str(), 1); }
  WithoutFetchedEngines(const WithoutFetchedEngines&) = delete;
  WithoutFetchedEngines& operator=(const WithoutFetchedEngines&) = delete;

 private:
  static constexpr const char* kName = "XDG_CACHE_HOME";
  std::string before_;
};

// An engine that is not on this machine is named on the page with its reason, and has no cell.
TEST(ContestRequest, AbsentEnginesHaveAReasonAndNoCell) {
  const WithoutFetchedEngines none;
  ContestRequest request;
  request.scenes = {"two-body:head-on"};
  const auto entrants = entrants_of(request);
  ASSERT_TRUE(entrants) << entrants.error().line();
  EXPECT_EQ(entrants.value().size(), default_entrants().size());
  const auto campaign = contest_campaign(request);
  ASSERT_TRUE(campaign) << campaign.error().line();
  for (const Entrant& e : entrants.value()) {
    const auto& cells = campaign.value().cells;
    const bool has_cell = std::any_of(cells.begin(), cells.end(), [&](const auto& w) { return w.engine == e.engine; });
    EXPECT_EQ(has_cell, e.absent.empty()) << e.engine;
  }
}

TEST(ContestRequest, RefusesWhatIsNoEntrant) {
  ContestRequest request;
  request.engines = {"plain-rigit"};
  ASSERT_FALSE(entrants_of(request));
  EXPECT_NE(entrants_of(request).error().line().find("plain-rigid"), std::string::npos);
  request.engines = {"all-pairs"};
  ASSERT_FALSE(entrants_of(request));
  EXPECT_NE(entrants_of(request).error().line().find("offers no dynamics"), std::string::npos);
  request.engines = {"plain-rigid[sweeps=3]"};
  EXPECT_FALSE(entrants_of(request));
}

TEST(ContestRequest, ABeginningThatNoSceneHasIsAnError) {
  ContestRequest request;
  request.scenes = {"rigid:nonsense:*"};
  const auto scenes = scenes_of(request);
  ASSERT_FALSE(scenes);
  EXPECT_NE(scenes.error().line().find("rigid:nonsense:"), std::string::npos);
}

}  // namespace
}  // namespace broadside::bench::contest
