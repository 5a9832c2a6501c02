// plain-rigid is not blamed: on random scenes, at three step sizes, no law reports a violation.
#include <gtest/gtest.h>

#include "bench/mutants/rigid_mutations.hpp"

namespace broadside::tests {
namespace {

void expect_no_blame(std::uint32_t scenes) {
  bench::MutationScore score;
  const core::Status status = bench::judge_sound_rigid(scenes, score, [] {});
  ASSERT_TRUE(status.ok()) << status.error().line();
  for (const bench::FalseAlarm& alarm : score.false_alarms)
    ADD_FAILURE() << alarm.scene << ": " << alarm.validator << ": " << alarm.explanation;
  EXPECT_GE(score.sound_runs, 3U * scenes);
  EXPECT_GT(score.verdicts_passed, 10U * score.sound_runs) << "hardly anything was judged";
}

TEST(SoundRigid, IsNotBlamedOnRandomScenes) {
  expect_no_blame(20);
}

TEST(SoundRigid, SlowIsNotBlamedOnTwoHundredRandomScenes) {
  expect_no_blame(200);
}

}  // namespace
}  // namespace broadside::tests
