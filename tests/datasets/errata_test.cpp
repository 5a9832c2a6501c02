// Each errata scene, run by the twin: with the printed form exactly the law of that erratum fails, with the sound form
// none does.
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "datasets/scenes.hpp"
#include "tests/datasets/twin_run.hpp"

namespace broadside {
namespace {

struct Erratum {
  const char* id;
  const char* law;
};

void PrintTo(const Erratum& e, std::ostream* out) {
  *out << e.id;
}

TEST(Springs, E1PrintedDivergesAndTheSoundFormRefusesTheStep) {
  const auto scene = datasets::make_scene("errata:E1");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  std::set<std::string> blamed;
  for (const core::Verdict& v : tests::verdicts_of(scene.value(), "printed-E1")) {
    if (v.outcome == core::Outcome::kFail) blamed.insert(v.validator);
    if (v.validator == "stability") {
      EXPECT_NE(v.explanation.find("body 0"), std::string::npos) << v.explanation;
    }
  }
  EXPECT_EQ(blamed, std::set<std::string>{"stability"});

  const core::EngineRow row = reference::octree_cpu_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  ASSERT_TRUE(engine.ok());
  const core::Status refused = engine.value().dynamics->load(scene.value());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().line().find("stable only below 0.0138"), std::string::npos) << refused.error().line();
}

// A spring whose step is below its limit breaks no law, however stiff it is.
TEST(Springs, BelowTheLimitArePassedByEveryLaw) {
  auto scene = datasets::make_scene("springs:hanging");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  for (const float stiffer : {1.0F, 30.0F}) {
    for (core::Spring& s : scene.value().springs) s.stiffness_n_m *= stiffer;
    for (const core::Verdict& v : tests::verdicts_of(scene.value(), "sound")) {
      EXPECT_NE(v.outcome, core::Outcome::kFail) << v.validator << ": " << v.explanation;
      if (v.validator == "stability") {
        EXPECT_EQ(v.outcome, core::Outcome::kPass) << v.explanation;
      }
    }
  }
}

class Errata : public testing::TestWithParam<Erratum> {};

TEST_P(Errata, ThePrintedFormFailsItsLawAloneAndTheSoundFormNone) {
  const auto scene = datasets::make_scene(std::string("errata:") + GetParam().id);
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  for (const bool is_printed : {true, false}) {
    const std::string variant = is_printed ? std::string("printed-") + GetParam().id : "sound";
    SCOPED_TRACE(variant);
    std::set<std::string> blamed;
    for (const core::Verdict& v : tests::verdicts_of(scene.value(), variant)) {
      if (v.outcome == core::Outcome::kFail) blamed.insert(v.validator);
      EXPECT_NE(v.outcome, core::Outcome::kInconclusive) << v.validator << ": " << v.explanation;
      if (v.validator != GetParam().law) continue;
      EXPECT_NE(v.outcome, core::Outcome::kNotApplicable) << v.explanation;
      EXPECT_GT(v.checked, 0U) << "the scene has nothing for " << v.validator << " to judge";
    }
    EXPECT_EQ(blamed, is_printed ? std::set<std::string>{GetParam().law} : std::set<std::string>{});
  }
}

INSTANTIATE_TEST_SUITE_P(Method, Errata,
                         testing::Values(Erratum{"E2", "candidate-set"}, Erratum{"E3", "center-of-mass"},
                                         Erratum{"E4", "contraction"}, Erratum{"E5", "normal-energy"},
                                         Erratum{"E6", "friction-energy"}, Erratum{"E7", "octree-invariants"}),
                         [](const auto& row) { return std::string(row.param.id); });

}  // namespace
}  // namespace broadside
