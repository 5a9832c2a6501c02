// The pass itself: which validators run, how frames are matched, what is refused, and the exit codes of verdicts.
#include "validation/judge.hpp"

#include <map>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "tests/validation/sound_world.hpp"
#include "validation/outcome.hpp"

namespace broadside::tests {
namespace {

using core::Outcome;

validation::FrameSource source_of(const Recording& r, const std::vector<std::uint64_t>& steps) {
  return {r.header, steps, [&r](std::uint64_t k, std::uint32_t) { return core::Result<FrameRecord>(r.frames[k]); }};
}

std::vector<std::uint64_t> steps_of(const Recording& r) {
  std::vector<std::uint64_t> steps;
  for (const FrameRecord& frame : r.frames) steps.push_back(frame.step);
  return steps;
}

TEST(Judge, RefusesABaselineOfAnotherScene) {
  Recording other = sound();
  other.header.stamp.scene_digest ^= 1;
  const auto steps = steps_of(sound());
  const auto a = source_of(sound(), steps);
  const auto b = source_of(other, steps);
  const auto result = validation::judge(a, &b, {});
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().line().find("different scenes"), std::string::npos) << result.error().line();
  EXPECT_EQ(result.error().exit, core::Exit::kBadInput);
}

TEST(Judge, RefusesAnUnknownValidatorAndNamesTheNearest) {
  const auto steps = steps_of(sound());
  validation::JudgeOptions options;
  options.only = {"contact-norml"};
  const auto result = validation::judge(source_of(sound(), steps), nullptr, options);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().line().find("contact-normal"), std::string::npos) << result.error().line();
}

TEST(Judge, HandsOnWhatTheReaderSays) {
  const auto steps = steps_of(sound());
  auto source = source_of(sound(), steps);
  source.read = [](std::uint64_t k, std::uint32_t) -> core::Result<FrameRecord> {
    if (k == 3) return core::Error{"the file is damaged"};
    return sound().frames[k];
  };
  const auto result = validation::judge(source, nullptr, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().what, "the file is damaged");
}

TEST(Judge, GivesOneVerdictPerValidatorInTheTablesOrder) {
  const auto verdicts = judged(sound());
  const auto table = validation::validators();
  ASSERT_EQ(verdicts.size(), table.size());
  for (std::size_t k = 0; k < table.size(); ++k) EXPECT_EQ(verdicts[k].validator, table[k].name);
  EXPECT_EQ(judged(sound(), nullptr, {"capacity"}).size(), 1u);
}

TEST(Judge, TellsProgressUpToTheEnd) {
  const auto steps = steps_of(sound());
  validation::JudgeOptions options;
  std::uint64_t last = 0;
  options.progress = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_EQ(total, steps.size());
    EXPECT_GT(done, last);
    last = done;
  };
  ASSERT_TRUE(validation::judge(source_of(sound(), steps), nullptr, options).ok());
  EXPECT_EQ(last, steps.size());
}

TEST(Judge, MatchesTheBaselineByStep) {
  Recording sparse = sound();
  std::erase_if(sparse.frames, [](const FrameRecord& f) { return f.step % 5 != 0; });
  const core::Verdict v = verdict_of("determinism", sound(), &sparse);
  EXPECT_EQ(v.outcome, Outcome::kPass) << line(v);
  EXPECT_EQ(v.checked, sparse.frames.size());
  sparse.frames[2].digest ^= 1;
  const core::Verdict wrong = verdict_of("determinism", sound(), &sparse);
  EXPECT_EQ(wrong.outcome, Outcome::kFail);
  EXPECT_EQ(wrong.worst.step, 15);
}

TEST(Judge, EveryKthFrameIsJudgedWithoutItsMissingPredecessors) {
  Recording sparse = sound();
  std::erase_if(sparse.frames, [](const FrameRecord& f) { return f.step % 7 != 0; });
  sparse.header.every = 7;
  sparse.statistics.clear();
  for (const core::Verdict& v : judged(sparse))
    EXPECT_TRUE(v.outcome == Outcome::kPass || v.outcome == Outcome::kNotApplicable) << line(v);
}

TEST(Judge, TheFrameBeforeIsThatOfTheStepBeforeOrNone) {
  Recording sparse = sound();
  std::erase_if(sparse.frames, [](const FrameRecord& f) { return f.step == 3 || f.step == 4; });
  const auto steps = steps_of(sparse);
  validation::JudgeOptions options;
  std::map<std::uint64_t, std::uint64_t> before;  // step of the frame before, by step; 0 = none
  options.observe = [&](const validation::Evidence& e) {
    before[e.frame.step] = e.previous != nullptr ? e.previous->step : 0;
  };
  ASSERT_TRUE(validation::judge(source_of(sparse, steps), nullptr, options).ok());
  EXPECT_EQ(before[1], 0U);
  EXPECT_EQ(before[2], 1U);
  EXPECT_EQ(before[5], 0U) << "steps 3 and 4 were not recorded";
  EXPECT_EQ(before[6], 5U);
}

TEST(Judge, AWrongFrameIsNamed) {
  Recording wrong = sound();
  wrong.frames[11].position[5].y = std::numeric_limits<float>::infinity();
  const core::Verdict v = verdict_of("state-sanity", wrong);
  EXPECT_EQ(v.outcome, Outcome::kFail);
  EXPECT_EQ(v.worst.step, 12);
  EXPECT_EQ(v.worst.bodies, std::vector<std::uint32_t>{5});
  EXPECT_FALSE(v.worst.field.empty());
}

TEST(Judge, MissingGroupsAreNotApplicableAndSaySo) {
  Recording digests = sound();
  digests.header.groups = 0;
  digests.header.level = core::RecordLevel::kDigest;
  for (const core::Verdict& v : judged(digests)) {
    EXPECT_EQ(v.outcome, Outcome::kNotApplicable) << line(v);
    EXPECT_FALSE(v.explanation.empty()) << v.validator;
  }
}

TEST(Judge, NoFramesProveNothing) {
  Recording empty = sound();
  empty.frames.clear();
  for (const core::Verdict& v : judged(empty)) EXPECT_EQ(v.outcome, Outcome::kNotApplicable) << line(v);
}

TEST(Judge, AnotherSolverIsNotHeldToTheMethodsLaws) {
  Recording bullet = sound();
  bullet.header.declaration = core::Declaration::of({{"contacts", "totals"}});
  for (const char* name : {"contraction", "restitution", "friction-energy", "velocity-cap"})
    EXPECT_EQ(verdict_of(name, bullet).outcome, Outcome::kNotApplicable) << name;
  bullet.frames[9].position[5].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(verdict_of("state-sanity", bullet).outcome, Outcome::kFail);
}

TEST(CandidateSet, SupersetEnginesMayHaveMoreButMissNothing) {
  Recording superset = sound();
  superset.header.broad_is_exact = false;
  superset.frames[0].pairs = {{1, 5}};
  const core::Verdict more = verdict_of("candidate-set", superset);
  EXPECT_EQ(more.outcome, Outcome::kPass) << line(more);
  EXPECT_NE(more.explanation.find("1 too many"), std::string::npos) << more.explanation;
  for (FrameRecord& frame : superset.frames) frame.pairs.clear();
  EXPECT_EQ(verdict_of("candidate-set", superset).outcome, Outcome::kFail);
}

// A repeated pair is not counted as an extra pair: for an engine that reports a superset, only the form of its list
// shows the fault.
TEST(CandidateSet, SupersetEnginesNameEachPairOnceAndInOrder) {
  Recording superset = sound();
  superset.header.broad_is_exact = false;
  FrameRecord& frame = bench::frame_with_pairs(superset);
  const std::vector<Pair> pairs = frame.pairs;
  frame.pairs.push_back(pairs.back());
  EXPECT_EQ(verdict_of("candidate-set", superset).outcome, Outcome::kFail);
  frame.pairs = pairs;
  frame.pairs.push_back({pairs.back().i, pairs.back().j + 1});
  EXPECT_EQ(verdict_of("candidate-set", superset).outcome, Outcome::kPass);
  std::swap(frame.pairs[pairs.size() - 1], frame.pairs[pairs.size()]);
  EXPECT_EQ(verdict_of("candidate-set", superset).outcome, Outcome::kFail);
}

TEST(CandidateSet, TwoStaticBodiesAreNoPair) {
  Recording r = sound();
  FrameRecord& frame = r.frames[0];
  frame.boxes[4] = frame.boxes[2];
  frame.pairs = {{2, 4}};
  EXPECT_EQ(verdict_of("candidate-set", r).outcome, Outcome::kPass);
  r.header.scene.bodies[4].inverse_mass = 0.0F;
  EXPECT_EQ(verdict_of("candidate-set", r).outcome, Outcome::kFail);
}

TEST(Determinism, ComparesOnlyTheSameStampAndTwins) {
  Recording other = sound();
  other.header.stamp.settings = "broad=tree,levels=A,solver=colored,threads=1,variant=sound,vertex_stage=on";
  EXPECT_EQ(verdict_of("determinism", sound(), &other).outcome, Outcome::kNotApplicable);
  other.header.stamp.settings = "broad=tree,levels=flat,solver=colored,threads=2,variant=sound,vertex_stage=on";
  EXPECT_EQ(verdict_of("determinism", sound(), &other).outcome, Outcome::kPass) << "threads change no bit";
  other.header.stamp.engine = "octree-gpu";
  EXPECT_EQ(verdict_of("determinism", sound(), &other).outcome, Outcome::kNotApplicable) << "a name says nothing";
  other.header.declaration = core::method_declaration("octree-cpu");
  other.header.stamp.settings = "block=256,broad=tree,levels=flat,solver=colored,variant=sound,vertex_stage=on";
  EXPECT_EQ(verdict_of("determinism", sound(), &other).outcome, Outcome::kPass) << "the twin";
  other.header.stamp.engine = "hash-cpu";
  other.header.declaration = core::method_declaration();
  EXPECT_EQ(verdict_of("determinism", sound(), &other).outcome, Outcome::kNotApplicable);
}

core::Verdict verdict_with(Outcome outcome) {
  core::Verdict v;
  v.outcome = outcome;
  return v;
}

TEST(Outcomes, TheWorstDecidesAndFailComesFirst) {
  using validation::exit_of;
  using validation::worst_outcome;
  const auto fail = verdict_with(Outcome::kFail);
  const auto open = verdict_with(Outcome::kInconclusive);
  const auto pass = verdict_with(Outcome::kPass);
  const auto none = verdict_with(Outcome::kNotApplicable);
  const auto worst = [](std::vector<core::Verdict> v) { return worst_outcome(v); };
  EXPECT_EQ(worst({pass, open, fail, none}), Outcome::kFail);
  EXPECT_EQ(worst({pass, open, none}), Outcome::kInconclusive);
  EXPECT_EQ(worst({none, pass}), Outcome::kPass);
  EXPECT_EQ(worst({none}), Outcome::kNotApplicable);
  EXPECT_EQ(worst({}), Outcome::kNotApplicable);
  EXPECT_EQ(exit_of(Outcome::kFail), core::Exit::kFailed);
  EXPECT_EQ(exit_of(Outcome::kInconclusive), core::Exit::kMissing);
  EXPECT_EQ(exit_of(Outcome::kPass), core::Exit::kGood);
  EXPECT_EQ(exit_of(Outcome::kNotApplicable), core::Exit::kGood);
}

}  // namespace
}  // namespace broadside::tests
