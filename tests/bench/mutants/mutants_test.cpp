// The mutation score: every wrong engine is caught by the validator meant for it, and the sound one by none.
#include "reference/mutants/mutants.hpp"

#include <gtest/gtest.h>

#include <set>

#include "bench/mutants/mutation_score.hpp"
#include "reference/mutants/serial_pipeline.hpp"
#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

TEST(Mutants, EachIsCaughtByTheValidatorMeantForIt) {
  bench::MutationOptions options;
  options.random_scenes = 5;
  const auto scored = bench::score_mutations(options);
  ASSERT_TRUE(scored.ok()) << scored.error().line();
  std::set<std::string> names;
  std::size_t engines = 0;
  for (const bench::MutationRow& row : scored.value().rows) {
    std::string who;
    for (const std::string& validator : row.caught_by) who += " " + validator;
    EXPECT_TRUE(row.is_caught) << row.name << ": meant for " << row.validator << ", caught by" << who
                               << row.why_not_run;
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
    if (!row.name.starts_with("trace: ")) ++engines;
  }
  EXPECT_GE(engines, 48U + 40U) << "the eight printed forms, and forty wrong engines of either kind";
  for (const bench::FalseAlarm& alarm : scored.value().false_alarms)
    ADD_FAILURE() << "false alarm on " << alarm.scene << ": " << alarm.validator << ": " << alarm.explanation;
  EXPECT_GT(scored.value().verdicts_passed, 100U) << "hardly anything was judged";
}

TEST(Mutants, OneByNameAndAnUnknownName) {
  bench::MutationOptions options;
  options.only = "printed-E3";
  const auto one = bench::score_mutations(options);
  ASSERT_TRUE(one.ok()) << one.error().line();
  ASSERT_EQ(one.value().rows.size(), 1U);
  EXPECT_EQ(one.value().rows[0].caught_by, std::vector<std::string>{"center-of-mass"});
  options.only = "printed-E33";
  const auto unknown = bench::score_mutations(options);
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().line().find("printed-E3"), std::string::npos) << unknown.error().line();
}

// A mutant is wrong only in the replaced stage: with no stage replaced, the base is the twin.
TEST(SerialPipeline, WithSoundStagesIsTheTwinBitForBit) {
  for (const char* name : {"mixed", "pile", "balls", "springs:hanging", "errata:E2"}) {
    const auto scene = bench::specimen_scene(name);
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    reference::SerialPipeline serial{reference::Stages{}};
    const Recording mine = record_frames(scene.value(), serial, reference::SerialPipeline::settings());
    const Recording twin = record(scene.value(), {{"broad", "octree"}, {"threads", "2"}});
    const core::Verdict v = verdict_of("determinism", mine, &twin);
    EXPECT_EQ(v.outcome, core::Outcome::kPass) << name << ": " << line(v);
    EXPECT_EQ(mine.header.groups, twin.header.groups);
  }
}

}  // namespace
}  // namespace broadside::tests
