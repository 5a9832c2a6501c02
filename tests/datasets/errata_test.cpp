// Each errata scene, run by the twin: with the printed form exactly the law of that erratum fails, with the sound form
// none does.
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "core/engine/settings.hpp"
#include "core/trace/trace_header.hpp"
#include "datasets/scenes.hpp"
#include "reference/octree_cpu/engine.hpp"
#include "validation/judge.hpp"

namespace broadside {
namespace {

struct Erratum {
  const char* id;
  const char* law;
};

void PrintTo(const Erratum& e, std::ostream* out) {
  *out << e.id;
}

std::vector<core::Verdict> verdicts_of(const core::Scene& scene, const std::string& variant) {
  const core::EngineRow row = reference::octree_cpu_row();
  const auto settings = core::Settings::parse(row.id, row.settings, {{"variant", variant}});
  EXPECT_TRUE(settings.ok()) << settings.error().line();
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok()) << engine.error().line();
  core::Dynamics& dynamics = *engine.value().dynamics;
  EXPECT_TRUE(dynamics.load(scene).ok());

  std::vector<core::FrameRecord> frames(scene.frames);
  std::vector<std::uint64_t> steps;
  for (core::FrameRecord& frame : frames) {
    EXPECT_TRUE(dynamics.step(scene.dt_s).ok());
    EXPECT_TRUE(dynamics.read_back(frame, core::RecordLevel::kFull).ok());
    steps.push_back(frame.step);
  }
  core::TraceHeader header;
  header.scene = scene;
  header.groups = dynamics.groups();
  header.stamp.scene_name = scene.name;
  header.stamp.scene_digest = core::scene_digest(scene);
  header.stamp.engine = std::string(row.id);
  header.stamp.settings = settings.value().canonical();
  header.stamp.settings_short = settings.value().short_form();
  const validation::FrameSource source{header, steps, [&](std::uint64_t index, std::uint32_t) {
                                         return core::Result<core::FrameRecord>(frames[index]);
                                       }};
  auto verdicts = validation::judge(source, nullptr, {});
  EXPECT_TRUE(verdicts.ok()) << verdicts.error().line();
  return verdicts.ok() ? std::move(verdicts).value() : std::vector<core::Verdict>{};
}

TEST(Springs, E1PrintedDivergesAndTheSoundFormRefusesTheStep) {
  const auto scene = datasets::make_scene("errata:E1");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  std::set<std::string> blamed;
  for (const core::Verdict& v : verdicts_of(scene.value(), "printed-E1")) {
    if (v.outcome == core::Outcome::kFail) blamed.insert(v.validator);
    if (v.validator == "stability") EXPECT_NE(v.explanation.find("body 0"), std::string::npos) << v.explanation;
  }
  EXPECT_EQ(blamed, std::set<std::string>{"stability"});

  const core::EngineRow row = reference::octree_cpu_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  ASSERT_TRUE(engine.ok());
  const core::Status refused = engine.value().dynamics->load(scene.value());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().line().find("stable only below 0.0138"), std::string::npos) << refused.error().line();
}

// Below its limit a spring is no fault, however hard it pulls.
TEST(Springs, BelowTheLimitArePassedByEveryLaw) {
  auto scene = datasets::make_scene("springs:hanging");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  for (const float stiffer : {1.0F, 30.0F}) {
    for (core::Spring& s : scene.value().springs) s.stiffness_n_m *= stiffer;
    for (const core::Verdict& v : verdicts_of(scene.value(), "sound")) {
      EXPECT_NE(v.outcome, core::Outcome::kFail) << v.validator << ": " << v.explanation;
      if (v.validator == "stability") EXPECT_EQ(v.outcome, core::Outcome::kPass) << v.explanation;
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
    for (const core::Verdict& v : verdicts_of(scene.value(), variant)) {
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
