// Laws over scenes that rapidcheck draws, and shrinks when one fails.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/scene/transformed_scene.hpp"
#include "tests/validation/engine_recording.hpp"
#include "validation/scene_relation.hpp"

namespace broadside::tests {
namespace {

using Kind = validation::SceneRelation::Kind;

// A random scene, short enough that hundreds can be run.
core::Scene drawn_scene() {
  core::Scene scene =
      bench::random_scene(*rc::gen::arbitrary<std::uint32_t>(), -2.0F, *rc::gen::element(1.0F, 10.0F, 1e4F));
  scene.frames = 12;
  const auto bodies = *rc::gen::inRange<std::size_t>(2, scene.bodies.size() + 1);
  scene.bodies.resize(bodies);
  return scene;
}

EngineSettings drawn_settings() {
  return *rc::gen::element(EngineSettings{}, EngineSettings{{"broad", "octree"}}, EngineSettings{{"levels", "flat"}},
                           EngineSettings{{"levels", "A"}, {"broad", "brute"}}, EngineSettings{{"solver", "jacobi"}});
}

// The validators that failed; "" when none did.
std::string blame(const Recording& subject, const Recording* baseline) {
  for (const core::Verdict& v : judged(subject, baseline))
    if (v.outcome == core::Outcome::kFail) return line(v);
  return "";
}

void holds_against(const core::Scene& scene, const core::Scene& other, Kind kind) {
  const auto relation = validation::relation_of(scene, other);
  RC_ASSERT(relation.has_value());
  RC_ASSERT(relation->kind == kind);
  const EngineSettings settings = drawn_settings();
  const Recording subject = record(scene, settings);
  const Recording baseline = record(other, settings);
  RC_ASSERT(blame(subject, &baseline) == "");
  const core::Verdict v = verdict_of("metamorphic", subject, &baseline);
  // Engines without a level 0 record no candidate pairs, so growing predicts nothing about their records.
  const bool has_pairs = (subject.header.groups & core::bit(core::Group::kPairs)) != 0;
  if (kind == Kind::kGrown && !has_pairs) return;
  if (v.outcome != core::Outcome::kPass) RC_FAIL(line(v));
}

RC_GTEST_PROP(Properties, TheSoundEngineIsNotBlamed, ()) {
  RC_ASSERT(blame(record(drawn_scene(), drawn_settings()), nullptr) == "");
}

RC_GTEST_PROP(Properties, AScaledSceneHasTheScaledOutcome, ()) {
  const core::Scene scene = drawn_scene();
  holds_against(scene, core::scaled_scene(scene, *rc::gen::element(0.125F, 0.5F, 2.0F, 16.0F)), Kind::kScaled);
}

RC_GTEST_PROP(Properties, AMirroredSceneHasTheMirroredOutcome, ()) {
  const core::Scene scene = drawn_scene();
  holds_against(scene, core::mirrored_scene(scene, *rc::gen::inRange(0, 3)), Kind::kMirrored);
}

RC_GTEST_PROP(Properties, ARenumberedSceneHasTheRenumberedOutcome, ()) {
  const core::Scene scene = drawn_scene();
  std::vector<std::uint32_t> order(scene.bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  // A rotation by at least one and a swap: never the identity.
  std::rotate(order.begin(),
              order.begin() + *rc::gen::inRange<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(order.size())),
              order.end());
  holds_against(scene, core::renumbered_scene(scene, order), Kind::kRenumbered);
}

// Three bodies in a row: the order of the two contacts decides the state of the last body, which then meets a face in
// another state. Its contact with the face was once taken for an error of the engine.
TEST(Renumbered, FacesAreMetByWhatSeveralContactsLeft) {
  core::Scene scene = bench::random_scene(1124966, -2.0F, 1e4F);
  scene.frames = 12;
  scene.bodies.resize(3);
  const std::uint32_t order[] = {1, 2, 0};
  const Recording subject = record(scene, {});
  const Recording baseline = record(core::renumbered_scene(scene, order), {});
  const core::Verdict v = verdict_of("metamorphic", subject, &baseline);
  EXPECT_EQ(v.outcome, core::Outcome::kPass) << line(v);
  EXPECT_NE(v.explanation.find("resolved in another order"), std::string::npos) << line(v);
}

// A body is as deep in one static body as in another. Whichever contact is applied first moves it out of the other
// body, so each run has only one contact, and not the same one.
TEST(Renumbered, AContactMayUndoAnother) {
  core::Scene scene;
  scene.name = "between";
  scene.meshes = {grid_cube(8)};
  scene.domain = {{-4, -4, -4}, {4, 4, 4}};
  scene.parameters.delta_m = 0.0F;
  scene.bodies.resize(3);
  scene.bodies[0].position = {0.0F, 0.0F, 0.0F};
  scene.bodies[1].position = {-0.875F, 0.75F, 0.0F};
  scene.bodies[2].position = {-0.875F, -0.75F, 0.0F};
  scene.bodies[1].inverse_mass = scene.bodies[2].inverse_mass = 0.0F;
  const std::uint32_t order[] = {0, 2, 1};
  const Recording subject = record(scene, {});
  const Recording baseline = record(core::renumbered_scene(scene, order), {});
  ASSERT_EQ(subject.frames[0].contacts.size(), 1U);
  ASSERT_EQ(baseline.frames[0].contacts.size(), 1U);
  ASSERT_EQ(subject.frames[0].contacts[0].b, baseline.frames[0].contacts[0].b) << "two bodies of the scene";
  const core::Verdict v = verdict_of("metamorphic", subject, &baseline);
  EXPECT_EQ(v.outcome, core::Outcome::kPass) << line(v);
}

RC_GTEST_PROP(Properties, GrownBoxesHaveNoFewerPairs, ()) {
  const core::Scene scene = drawn_scene();
  holds_against(scene, core::grown_scene(scene, *rc::gen::element(1.125F, 1.5F, 3.0F)), Kind::kGrown);
}

// Mirrored twice, renumbered there and back, scaled up and down: the result is the scene itself.
RC_GTEST_PROP(Properties, TransformationsCanBeUndone, ()) {
  const core::Scene scene = drawn_scene();
  const std::uint64_t digest = core::scene_digest(scene);
  const int axis = *rc::gen::inRange(0, 3);
  const core::Scene mirrored = core::mirrored_scene(core::mirrored_scene(scene, axis), axis);
  RC_ASSERT(core::scene_digest(mirrored) == digest);
  RC_ASSERT(core::scene_digest(core::scaled_scene(core::scaled_scene(scene, 8.0F), 0.125F)) == digest);
  RC_ASSERT(!validation::relation_of(scene, mirrored).has_value());
}

}  // namespace
}  // namespace broadside::tests
