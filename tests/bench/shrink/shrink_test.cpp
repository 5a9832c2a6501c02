// Shrinking ends at the smallest scene or box set that shows a known fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/engines.hpp"
#include "bench/shrink/case_text.hpp"
#include "bench/shrink/minimal_subset.hpp"
#include "bench/shrink/shrink_boxes.hpp"
#include "bench/shrink/shrink_scene.hpp"
#include "bench/shrink/simpler_scene.hpp"
#include "bench/shrink/trial.hpp"
#include "core/mesh/clean_mesh.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/scenes.hpp"

namespace broadside::tests {
namespace {

using bench::TrialAnswer;

core::Scene named(const std::string& name, std::uint32_t frames = 0) {
  datasets::SceneOptions options;
  if (frames > 0) options.frames = frames;
  auto scene = datasets::make_scene(name, options);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  return std::move(scene).value();
}

std::vector<int> numbers(int count) {
  std::vector<int> list;
  for (int k = 0; k < count; ++k) list.push_back(k);
  return list;
}

TEST(MinimalSubset, KeepsExactlyWhatIsNeeded) {
  const std::set<int> needed{3, 500, 501, 999};
  int trials = 0;
  const auto fails = [&](const std::vector<int>& part) {
    ++trials;
    return std::all_of(needed.begin(), needed.end(),
                       [&](int n) { return std::find(part.begin(), part.end(), n) != part.end(); });
  };
  const std::vector<int> left = bench::minimal_subset(numbers(1000), fails, [] { return false; });
  EXPECT_EQ(left, std::vector<int>(needed.begin(), needed.end()));
  EXPECT_LT(trials, 300) << "a thousand numbers one by one would be 1000";
}

TEST(MinimalSubset, StopsWithAFailingListWhenTimeIsUp) {
  int trials = 0;
  const auto fails = [](const std::vector<int>& part) { return std::find(part.begin(), part.end(), 77) != part.end(); };
  const std::vector<int> left = bench::minimal_subset(numbers(1000), fails, [&] { return ++trials > 3; });
  EXPECT_GT(left.size(), 1U);
  EXPECT_TRUE(fails(left));
}

bench::ShrinkLimits no_hurry() {
  return {300.0, {}};
}

// A fault of a law of our own: two bodies, both lighter than usual, end a step nearer to each other than 1.5 m.
core::Result<TrialAnswer> light_pair_oracle(const core::Scene& scene) {
  auto answer = bench::ask({"state-sanity", {bench::find_engine("octree-cpu").value(), {}}, {}}, scene);
  if (!answer) return answer;
  core::Verdict& v = answer.value().verdict;
  v.outcome = core::Outcome::kPass;
  const auto& bodies = answer.value().end;
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      const core::Vec3 d = bodies[i].position - bodies[j].position;
      if (bodies[i].inverse_mass < 1.5F || bodies[j].inverse_mass < 1.5F || dot(d, d) > 2.25F) continue;
      v.outcome = core::Outcome::kFail;
      v.worst.step = scene.frames;
    }
  return answer;
}

TEST(ShrinkScene, EndsAtTheTwoBodiesThatMatter) {
  core::Scene scene = named("freefall:cube:60", 40);
  const std::vector<std::uint32_t> order = bench::by_distance(scene, std::vector<std::uint32_t>{7});
  scene.bodies[order[0]].inverse_mass = 2.0F;
  scene.bodies[order[1]].inverse_mass = 4.0F;
  const auto shrunk = bench::shrink_scene(scene, light_pair_oracle, no_hurry());
  ASSERT_TRUE(shrunk.ok()) << shrunk.error().line();
  EXPECT_EQ(shrunk.value().scene.body_count(), 2U);
  EXPECT_EQ(shrunk.value().scene.frames, 1U);
  ASSERT_EQ(shrunk.value().scene.meshes.size(), 1U);
  EXPECT_EQ(shrunk.value().scene.meshes[0]->triangles.size(), 1U) << "no mesh matters, and a body needs a triangle";
  EXPECT_FALSE(shrunk.value().is_out_of_time);
  EXPECT_TRUE(core::check_scene(shrunk.value().scene).ok());
  // Once, digits of a single triangle were rounded until it had no area, and then no file could hold it.
  core::Mesh mesh = *shrunk.value().scene.meshes[0];
  EXPECT_TRUE(core::clean_mesh(mesh).is_nothing());
}

TEST(ShrinkScene, IsDeterministic) {
  core::Scene scene = named("freefall:cube:20", 5);
  const std::vector<std::uint32_t> order = bench::by_distance(scene, std::vector<std::uint32_t>{1});
  scene.bodies[order[0]].inverse_mass = scene.bodies[order[1]].inverse_mass = 2.0F;
  const auto first = bench::shrink_scene(scene, light_pair_oracle, no_hurry());
  const auto second = bench::shrink_scene(scene, light_pair_oracle, no_hurry());
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(core::scene_digest(first.value().scene), core::scene_digest(second.value().scene));
  EXPECT_EQ(first.value().trials, second.value().trials);
}

TEST(ShrinkScene, OfASoundEngineIsNothingToDo) {
  const bench::Question question{"normal-energy", {bench::find_engine("octree-cpu").value(), {}}, {}};
  const auto shrunk = bench::shrink_scene(
      named("errata:E5"), [&](const core::Scene& s) { return bench::ask(question, s); }, no_hurry());
  ASSERT_FALSE(shrunk.ok());
  EXPECT_NE(shrunk.error().line().find("nothing to shrink"), std::string::npos) << shrunk.error().line();
}

TEST(ShrinkScene, TurnsAPrintedFormIntoACaseThatRepeatsIt) {
  const bench::Question question{
      "normal-energy", {bench::find_engine("octree-cpu").value(), {{"variant", "printed-E5"}}}, {}};
  const auto shrunk = bench::shrink_scene(
      named("errata:E5"), [&](const core::Scene& s) { return bench::ask(question, s); }, no_hurry());
  ASSERT_TRUE(shrunk.ok()) << shrunk.error().line();
  EXPECT_LE(shrunk.value().scene.body_count(), 3U);
  EXPECT_LE(shrunk.value().scene.frames, 5U);
  EXPECT_EQ(shrunk.value().verdict.outcome, core::Outcome::kFail);
}

// Once, when bodies were dropped, their springs were attached to other bodies.
TEST(WithBodies, KeepsTheSpringsOfThoseThatStay) {
  const core::Scene scene = named("springs:hanging");
  const core::Scene last = bench::with_bodies(scene, std::vector<std::uint32_t>{2});
  std::size_t wanted = 0;
  for (const core::Spring& s : scene.springs) wanted += s.body == 2 ? 1 : 0;
  ASSERT_GT(wanted, 0U);
  ASSERT_LT(wanted, scene.springs.size());
  ASSERT_EQ(last.springs.size(), wanted);
  for (const core::Spring& s : last.springs) EXPECT_EQ(s.body, 0U);
  EXPECT_TRUE(core::check_scene(last).ok());
}

TEST(ShrinkScene, OfAFaultOnSpringsEndsAtOne) {
  const bench::Question question{
      "stability", {bench::find_engine("octree-cpu").value(), {{"variant", "printed-E1"}}}, {}};
  const auto shrunk = bench::shrink_scene(
      named("errata:E1"), [&](const core::Scene& s) { return bench::ask(question, s); }, no_hurry());
  ASSERT_TRUE(shrunk.ok()) << shrunk.error().line();
  EXPECT_EQ(shrunk.value().scene.body_count(), 1U);
  EXPECT_EQ(shrunk.value().scene.springs.size(), 1U);
  EXPECT_EQ(shrunk.value().verdict.outcome, core::Outcome::kFail);
  const std::string text = bench::case_text(
      shrunk.value().scene, {"a command", "octree-cpu[variant=printed-E1]", "stability", "octree-cpu", {}});
  EXPECT_NE(text.find("scene.springs = {"), std::string::npos) << text;
  EXPECT_NE(text.find("\"stability\", \"octree-cpu\")"), std::string::npos) << "the other engine is named: " << text;
}

TEST(ShrinkScene, SaysWhenTimeIsUpBeforeAFaultIsFound) {
  const auto passes = [](const core::Scene& scene) -> core::Result<TrialAnswer> {
    TrialAnswer answer{{}, scene.bodies};
    answer.verdict.outcome = core::Outcome::kPass;
    return answer;
  };
  const auto shrunk = bench::shrink_scene(named("freefall:cube:20", 1000), passes, {0.0, {}});
  ASSERT_FALSE(shrunk.ok());
  EXPECT_NE(shrunk.error().line().find("of 1000 frames within 0 s"), std::string::npos) << shrunk.error().line();
}

TEST(ShrinkScene, FindsAFaultOfAComparisonOfTwoEngines) {
  const core::EngineRow* octree = bench::find_engine("octree-cpu").value();
  const bench::Question question{"determinism", {octree, {{"variant", "printed-E3"}}}, bench::CellSpec{octree, {}}};
  // Two settings are two stamps: the law does not apply, and the verdict says so.
  const auto answer = bench::ask(question, named("errata:E3"));
  ASSERT_TRUE(answer.ok()) << answer.error().line();
  EXPECT_EQ(answer.value().verdict.outcome, core::Outcome::kNotApplicable);
  // Where no baseline is named, a second run of the same engine is the baseline.
  const auto alone = bench::ask({"determinism", {octree, {}}, {}}, named("errata:E3"));
  ASSERT_TRUE(alone.ok()) << alone.error().line();
  EXPECT_EQ(alone.value().verdict.outcome, core::Outcome::kPass) << alone.value().verdict.explanation;
}

// Forgets each pair whose first box starts right of x = 0 and whose second box is wider than 1.
core::Result<std::vector<core::Pair>> forgetful(const std::vector<core::Box>& boxes) {
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j]) && !(boxes[i].min.x > 0.0F && boxes[j].max.x - boxes[j].min.x > 1.0F))
        pairs.push_back({i, j});
  return pairs;
}

TEST(ShrinkBoxes, EndsAtTheTwoBoxesOfAForgottenPair) {
  auto stream = datasets::make_box_stream("boxes:uniform:500");
  ASSERT_TRUE(stream.ok());
  const auto shrunk = bench::shrink_boxes(stream.value().boxes, forgetful, no_hurry());
  ASSERT_TRUE(shrunk.ok()) << shrunk.error().line();
  ASSERT_EQ(shrunk.value().boxes.size(), 2U);
  EXPECT_EQ(shrunk.value().missed, (std::vector<core::Pair>{{0, 1}}));
  EXPECT_TRUE(shrunk.value().extra.empty());
  // Digits were rounded too: each number has at most one digit left.
  for (const core::Box& b : shrunk.value().boxes)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(b.min[k], bench::rounded_to(b.min[k], 1));
}

TEST(ShrinkBoxes, OfARightEngineIsNothingToDo) {
  auto stream = datasets::make_box_stream("boxes:uniform:50");
  ASSERT_TRUE(stream.ok());
  const auto right = [](const std::vector<core::Box>& boxes) -> core::Result<std::vector<core::Pair>> {
    std::vector<core::Pair> pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
        if (core::overlaps(boxes[j], boxes[i])) pairs.push_back({i, j});
    return pairs;
  };
  EXPECT_FALSE(bench::shrink_boxes(stream.value().boxes, right, no_hurry()).ok());
}

TEST(RoundedTo, GivesTheNearestFloatOfFewDigits) {
  EXPECT_EQ(bench::rounded_to(0.123456F, 2), 0.12F);
  EXPECT_EQ(bench::rounded_to(-98765.4F, 1), -100000.0F);
  EXPECT_EQ(bench::rounded_to(3.14F, 0), 0.0F);
  EXPECT_EQ(bench::rounded_to(1.0F / 3.0F, 9), 1.0F / 3.0F);
}

}  // namespace
}  // namespace broadside::tests
