// What proves a motion: a law that ties it to forces, on bodies that moved. An engine that does nothing proves none.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/verdict.hpp"
#include "reports/admission.hpp"
#include "tests/validation/corruption.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::tests {
namespace {

bool is_proven(const std::vector<core::Verdict>& verdicts) {
  return std::any_of(verdicts.begin(), verdicts.end(), core::proves_motion);
}

// A scene without gravity and without speeds, for which doing nothing is right.
Recording of_nothing() {
  core::Scene scene = sound_run("two-body:apart").header.scene;
  scene.gravity_m_s2 = {};
  for (core::Body& body : scene.bodies) body.velocity = {};
  return record(scene, {});
}

TEST(ProvenMotion, OfARightRunByItsIntegrationAndItsFreeFlight) {
  const std::vector<core::Verdict> verdicts = judged(sound());
  EXPECT_TRUE(is_proven(verdicts));
  const auto of = [&](const char* name) {
    return *std::find_if(verdicts.begin(), verdicts.end(), [&](const auto& v) { return v.validator == name; });
  };
  EXPECT_TRUE(core::proves_motion(of("state-sanity"))) << "P(1) to P(3), because the trace declares the method";
  EXPECT_FALSE(core::proves_motion(of("candidate-set")));
}

TEST(ProvenMotion, AnEngineThatDoesNothingProvesNone) {
  const Recording still = of_nothing();
  const std::vector<core::Verdict> verdicts = judged(still);
  for (const core::Verdict& v : verdicts) EXPECT_EQ(v.moved, 0U) << line(v);
  EXPECT_FALSE(is_proven(verdicts));
}

// From the trace to the struck-out time, by laws that all pass.
TEST(ProvenMotion, TheTimeOfAnEngineThatDoesNothingIsNotAdmitted) {
  const auto admission_of = [](const Recording& r) {
    core::RunRows rows;
    rows.cells.push_back(
        {.stamp = r.header.stamp, .state = core::CellState::kRecorded, .frames = 1, .digests = {{1, 7}}});
    core::CellVerdicts cell{.stamp = r.header.stamp,
                            .verdicts = judged(r, nullptr, {"state-sanity", "ballistic", "penetration"})};
    cell.is_simulation = validation::moves_bodies(r.header);
    for (const core::Verdict& v : cell.verdicts) EXPECT_NE(v.outcome, core::Outcome::kFail) << line(v);
    rows.verdicts.push_back(cell);
    core::Sample sample{.stamp = r.header.stamp};
    sample.final_digest = 7;
    sample.final_step = 1;
    return reports::admit(sample, rows);
  };
  EXPECT_TRUE(admission_of(sound()).is_admitted) << admission_of(sound()).reason;
  const reports::Admission refused = admission_of(of_nothing());
  EXPECT_FALSE(refused.is_admitted);
  EXPECT_TRUE(refused.reason.starts_with("its motion was not proven")) << refused.reason;
}

TEST(ProvenMotion, IntegrationIsHeldAgainstTracesOfTheMethodAlone) {
  Recording foreign = sound();
  foreign.header.declaration = {};
  const core::Verdict v = verdict_of("state-sanity", foreign);
  EXPECT_EQ(v.outcome, core::Outcome::kPass) << line(v);
  EXPECT_EQ(v.moved, 0U);
  const auto part =
      std::find_if(v.parts.begin(), v.parts.end(), [](const auto& p) { return p.validator == "integration"; });
  ASSERT_NE(part, v.parts.end());
  EXPECT_EQ(part->outcome, core::Outcome::kNotApplicable);
}

// Once, 68,495 violations were reported under one worst value, which hid the laws that they broke.
TEST(StateSanity, EachOfItsLawsHasItsOwnWorstPlaceAndCount) {
  Recording r = sound();
  const std::size_t last = r.frames.size() - 1;
  r.frames[3].velocity[0].x = std::numeric_limits<float>::infinity();
  r.frames[last].orientation[1].w = 1.001F;
  r.frames[5].boxes[1].max.x += 1e-3F;
  r.frames[7].time_s += 1.0;
  const core::Verdict v = verdict_of("state-sanity", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail);
  std::uint64_t checked = 0;
  std::uint64_t violations = 0;
  std::map<std::string, core::Verdict> parts;
  for (const core::Verdict& part : v.parts) {
    checked += part.checked;
    violations += part.violations;
    parts[part.validator] = part;
  }
  EXPECT_EQ(checked, v.checked);
  EXPECT_EQ(violations, v.violations);
  const auto expect_at = [&](const char* law, std::size_t frame, const char* field) {
    EXPECT_EQ(parts[law].outcome, core::Outcome::kFail) << law;
    EXPECT_EQ(parts[law].worst.step, static_cast<std::int64_t>(r.frames[frame].step)) << law;
    EXPECT_EQ(parts[law].worst.field, field);
    EXPECT_NE(v.explanation.find(std::string(law) + " "), std::string::npos) << v.explanation;
  };
  expect_at("finite", 3, "bodies.velocity");
  expect_at("unit-orientation", last, "bodies.orientation");
  expect_at("moved-boxes", 5, "boxes");
  expect_at("record", 7, "time");
  EXPECT_EQ(parts["finite"].violations, 1U);
  EXPECT_EQ(parts["record"].violations, 1U);
}

}  // namespace
}  // namespace broadside::tests
