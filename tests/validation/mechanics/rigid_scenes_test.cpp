// plain-rigid on the scenes with a known outcome: every law that applies holds, and the answer too. No right engine is
// blamed, at three step sizes.
#include "datasets/generators/rigid/rigid_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "reference/plain_rigid/engine.hpp"
#include "validation/judge.hpp"
#include "validation/mechanics/scene_answer.hpp"

namespace broadside::tests {
namespace {

using core::Scene;

Scene made(const datasets::SmallSceneRow& row, double step_factor) {
  Scene scene = row.make();
  scene.name = row.name;
  scene.frames = static_cast<std::uint32_t>(std::lround(scene.frames / step_factor));
  scene.dt_s = static_cast<float>(scene.dt_s * step_factor);
  return scene;
}

// The verdicts on plain-rigid in this scene, judged as it runs; none where it does not support a shape.
std::vector<core::Verdict> verdicts_on(const Scene& scene) {
  const reference::plain::WorldOptions options;
  reference::plain::PlainWorld engine(options);
  if (const core::Status s = engine.load(scene); !s) {
    EXPECT_NE(s.error().line().find("unsupported"), std::string::npos) << s.error().line();
    EXPECT_EQ(s.error().exit, core::Exit::kMissing);
    return {};
  }
  core::TraceHeader header;
  header.scene = scene;
  header.stamp.scene_digest = core::scene_digest(scene);
  header.groups = engine.groups();
  header.declaration = reference::plain::declaration(options);
  std::vector<std::uint64_t> steps(scene.frames);
  for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = k + 1;
  const validation::FrameSource source{header, steps,
                                       [&](std::uint64_t, std::uint32_t) -> core::Result<core::FrameRecord> {
                                         if (core::Status s = engine.step(scene.dt_s); !s) return s.error();
                                         core::FrameRecord frame;
                                         if (core::Status s = engine.read_back(frame, core::RecordLevel::kFull); !s)
                                           return s.error();
                                         return frame;
                                       }};
  auto judged = validation::judge(source, nullptr, {});
  EXPECT_TRUE(judged.ok()) << judged.error().line();
  return judged.ok() ? judged.value() : std::vector<core::Verdict>{};
}

void expect_all_hold(const datasets::SmallSceneRow& row, double step_factor) {
  const Scene scene = made(row, step_factor);
  SCOPED_TRACE(scene.name + " at " + std::to_string(step_factor) + " of its step");
  ASSERT_TRUE(core::check_scene(scene).ok()) << core::check_scene(scene).error().line();
  int applied = 0;
  bool has_answer = false;
  for (const core::Verdict& v : verdicts_on(scene)) {
    EXPECT_NE(v.outcome, core::Outcome::kFail) << v.validator << ": " << v.explanation;
    EXPECT_NE(v.outcome, core::Outcome::kInconclusive) << v.validator << ": " << v.explanation;
    applied += v.outcome == core::Outcome::kPass ? 1 : 0;
    const bool is_answer = v.validator == "closed-form" || v.validator == "rest";
    has_answer = has_answer || (is_answer && v.outcome == core::Outcome::kPass);
  }
  if (applied == 0) return;  // plain-rigid does not support a shape of this scene
  EXPECT_GE(applied, 4);
  EXPECT_TRUE(has_answer || scene.answer == validation::kReported);
}

// Bodies times steps; below this number a scene takes a fraction of a second.
constexpr std::uint64_t kShort = 1300;

TEST(RigidScenes, AllLawsHoldForPlainRigidOnShortScenes) {
  int count = 0;
  for (const datasets::SmallSceneRow& row : datasets::rigid_scenes()) {
    const Scene scene = row.make();
    if (std::uint64_t{scene.frames} * scene.bodies.size() > kShort) continue;
    ++count;
    expect_all_hold(row, 1.0);
  }
  EXPECT_GE(count, 20);
}

TEST(RigidScenes, SlowAllLawsHoldForPlainRigidAtThreeStepSizes) {
  for (const double factor : {1.0, 0.5, 0.25})
    for (const datasets::SmallSceneRow& row : datasets::rigid_scenes()) expect_all_hold(row, factor);
}

}  // namespace
}  // namespace broadside::tests
