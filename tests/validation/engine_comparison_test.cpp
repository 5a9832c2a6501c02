// Traces of the CPU twin against other traces of it, and against FCL's distances of the same meshes.
#include <utility>

#include "reference/engines.hpp"
#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

using core::Outcome;

constexpr const char* kLevels[] = {"flat", "level1", "A", "B", "C"};

Recording at_levels(const std::string& scene, const std::string& levels) {
  return record(named_scene(scene), {{"broad", "brute"}, {"levels", levels}});
}

TEST(LevelAgreement, EverySettingAgreesWithEveryOther) {
  std::vector<Recording> recordings;
  for (const char* levels : kLevels) recordings.push_back(at_levels("two-body:glancing", levels));
  for (const Recording& subject : recordings)
    for (const Recording& baseline : recordings) {
      const core::Verdict v = verdict_of("level-agreement", subject, &baseline);
      EXPECT_EQ(v.outcome, Outcome::kPass) << subject.header.stamp.settings << ": " << line(v);
      EXPECT_FALSE(v.baseline.empty()) << "nothing was compared";
    }
}

TEST(LevelAgreement, AWronglySkippedChildIsRejectedAloneAndAgainstABaseline) {
  const Recording baseline = at_levels("two-body:glancing", "C");
  Recording skipped = at_levels("two-body:glancing", "B");
  for (FrameRecord& frame : skipped.frames)
    if (!frame.confirmed.empty()) {
      frame.confirmed.clear();
      frame.proximity.clear();
      break;
    }
  EXPECT_EQ(verdict_of("level-agreement", skipped).outcome, Outcome::kFail);
  const core::Verdict v = verdict_of("level-agreement", skipped, &baseline);
  EXPECT_EQ(v.outcome, Outcome::kFail);
  // One violation within the trace itself, and one against the baseline.
  EXPECT_EQ(v.violations, 2u) << line(v);
}

TEST(LevelAgreement, OtherPhysicsIsNotCompared) {
  const Recording sound_engine = record(named_scene("errata:E3"), {});
  const Recording printed = record(named_scene("errata:E3"), {{"variant", "printed-E3"}});
  const core::Verdict v = verdict_of("level-agreement", printed, &sound_engine);
  EXPECT_EQ(v.outcome, Outcome::kPass) << line(v);
  EXPECT_TRUE(v.baseline.empty()) << "a printed variant is no baseline for levels";
}

TEST(Determinism, OneAndTwoThreadsAreTheSameRun) {
  for (const char* scene : {"two-body:glancing", "errata:E2", "errata:E6"}) {
    const Recording one = record(named_scene(scene), {{"threads", "1"}});
    const Recording two = record(named_scene(scene), {{"threads", "2"}});
    const core::Verdict v = verdict_of("determinism", two, &one);
    EXPECT_EQ(v.outcome, Outcome::kPass) << line(v);
    EXPECT_EQ(v.checked, one.frames.size());
  }
}

// FCL's distance of the pairs that the subject confirmed.
Recording measured_by_fcl(const Recording& subject) {
  const core::EngineRow row = reference::fcl_mesh_row();
  auto settings = core::Settings::parse(row.id, row.settings, {});
  auto created = row.create(settings.value());
  EXPECT_TRUE(created.ok()) << (created.ok() ? "" : created.error().line());
  core::NarrowPhase& narrow = *created.value().narrow_phase;
  const core::Scene& scene = subject.header.scene;
  EXPECT_TRUE(narrow.load(scene).ok());

  Recording measured;
  measured.header = subject.header;
  measured.header.stamp.engine = row.id;
  measured.header.stamp.settings.clear();
  measured.header.groups = core::bit(core::Group::kDetection) | core::bit(core::Group::kNarrow);
  measured.header.driver = subject.header.stamp.label();
  for (const FrameRecord& frame : subject.frames) {
    if (frame.confirmed.empty()) continue;
    FrameRecord out;
    out.step = frame.step;
    out.detected_position = frame.detected_position;
    out.detected_velocity = frame.detected_velocity;
    out.boxes = frame.boxes;
    out.measured = frame.confirmed;
    std::vector<core::Pose> poses;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      poses.push_back({frame.detected_position[i], scene.bodies[i].orientation});
    EXPECT_TRUE(narrow.measure(out.measured, poses).ok());
    auto separations = narrow.read_back();
    EXPECT_TRUE(separations.ok());
    out.separations = std::move(separations).value();
    measured.frames.push_back(std::move(out));
  }
  EXPECT_FALSE(measured.frames.empty());
  return measured;
}

TEST(ProximityBound, HoldsAgainstFclOnOverlappingMeshes) {
  for (const char* scene : {"two-body:glancing", "errata:E3"}) {
    const Recording subject = record(named_scene(scene), {});
    const Recording fcl = measured_by_fcl(subject);
    const core::Verdict v = verdict_of("proximity-bound", subject, &fcl);
    EXPECT_EQ(v.outcome, Outcome::kPass) << line(v);
    EXPECT_EQ(v.baseline, "fcl-mesh");
    EXPECT_NE(v.explanation.find("E13"), std::string::npos) << v.explanation;
  }
}

// METHOD 3's bound to a millimeter, on cubes of which every face is two triangles: rho of a right triangle with legs of
// 1 m is half its longest side, so rho_A + rho_B = sqrt(2) m. Their faces, and so their nearest vertices, are 2 m
// apart.
TEST(ProximityBound, IsTheDistancePlusBothCoveringRadii) {
  core::Scene scene;
  scene.name = "far";
  scene.meshes = {grid_cube(1)};
  scene.bodies = {body_at({0, 0, 0}, {}, 1.0F), body_at({3, 0, 0}, {}, 1.0F)};
  Recording subject;
  subject.header.scene = scene;
  subject.header.groups = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);
  FrameRecord& frame = subject.frames.emplace_back();
  frame.step = 1;
  frame.detected_position = {{0, 0, 0}, {3, 0, 0}};
  frame.detected_velocity.resize(2);
  frame.boxes = {{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}}, {{2.5F, -0.5F, -0.5F}, {3.5F, 0.5F, 0.5F}}};
  frame.confirmed = {{0, 1}};
  Recording baseline = subject;
  baseline.header.groups = core::bit(core::Group::kNarrow) | core::bit(core::Group::kDetection);
  baseline.header.stamp.engine = "exact-mesh";
  baseline.frames[0].measured = {{0, 1}};
  const auto outcome_at = [&](double distance_m) {
    baseline.frames[0].separations.assign(1, {});
    baseline.frames[0].separations[0].distance_m = distance_m;
    return verdict_of("proximity-bound", subject, &baseline).outcome;
  };
  const double cover = std::sqrt(2.0);
  // Not touching: d >= theta - rho_A - rho_B.
  subject.header.scene.parameters.theta_m = baseline.header.scene.parameters.theta_m = 1.875F;
  frame.proximity.assign(1, {});
  EXPECT_EQ(outcome_at(1.875 - cover + 1e-3), Outcome::kPass);
  EXPECT_EQ(outcome_at(1.875 - cover - 1e-3), Outcome::kFail);
  // Touching: d <= d_vv <= d + rho_A + rho_B.
  subject.header.scene.parameters.theta_m = baseline.header.scene.parameters.theta_m = 3.0F;
  std::uint32_t right = 0;  // a vertex with x = 1/2; the same place on the other cube has x = 5/2
  const auto& vertices = scene.meshes[0]->vertices;
  while (vertices[right].x < 0.0F) ++right;
  std::uint32_t left = 0;
  while (!(vertices[left] == Vec3{-0.5F, vertices[right].y, vertices[right].z})) ++left;
  frame.proximity[0] = {4.0F, right, left};
  EXPECT_EQ(outcome_at(2.0 - cover + 1e-3), Outcome::kPass);
  EXPECT_EQ(outcome_at(2.0 - cover - 1e-3), Outcome::kFail);
  EXPECT_EQ(outcome_at(2.0 - 1e-3), Outcome::kPass);
  EXPECT_EQ(outcome_at(2.0 + 1e-3), Outcome::kFail);
}

// d_vv between the surfaces' distance and that plus both covering radii; a baseline outside that is refused.
TEST(ProximityBound, RejectsDistancesThatTheVerticesContradict) {
  const Recording subject = record(named_scene("two-body:glancing"), {});
  Recording baseline = measured_by_fcl(subject);
  const auto set_distance = [&](double d) {
    for (FrameRecord& frame : baseline.frames)
      for (core::Separation& s : frame.separations) s.distance_m = d, s.is_touching = false;
  };
  // theta, and so every d_vv, is below 0.2 m: surfaces cannot be 0.25 m apart.
  set_distance(0.25);
  EXPECT_EQ(verdict_of("proximity-bound", subject, &baseline).outcome, Outcome::kFail);
  // Nearest vertices moved 1 m away from the surfaces' distance: more than any covering radius of these meshes.
  Recording far = subject;
  for (FrameRecord& frame : far.frames)
    for (core::Proximity& p : frame.proximity)
      if (p.is_touching()) p.squared_distance_m2 = 1.0F;
  set_distance(1e-6);
  EXPECT_EQ(verdict_of("proximity-bound", far, &baseline).outcome, Outcome::kFail);
  // Distances at other positions say nothing about these vertices.
  set_distance(0.25);
  for (FrameRecord& frame : baseline.frames) frame.detected_position[0].x += 0.5F;
  const core::Verdict elsewhere = verdict_of("proximity-bound", subject, &baseline);
  EXPECT_EQ(elsewhere.outcome, Outcome::kPass) << line(elsewhere);
  EXPECT_TRUE(elsewhere.baseline.empty());
}

}  // namespace
}  // namespace broadside::tests
