// Many steps in one call against the same steps one by one: each must be the same frame.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <vector>

#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/small_scenes.hpp"
#include "tests/gpu/twin_comparison.hpp"

namespace broadside::gpu {

// What the host knows of a step when it learns that the step is done.
struct StepSeen {
  unsigned long long pairs = 0;
  unsigned long long confirmed = 0;
  unsigned long long touching = 0;
  unsigned long long faces = 0;
  std::uint32_t colors = 0;

  friend bool operator==(const StepSeen&, const StepSeen&) = default;
};
inline void PrintTo(const StepSeen& s, std::ostream* out) {
  *out << s.pairs << " pairs, " << s.confirmed << " confirmed, " << s.touching << " touching, " << s.faces
       << " with faces, " << s.colors << " colors";
}

inline StepSeen seen_by(const Pipeline& pipeline) {
  const Counters& c = pipeline.frame_counts();
  return {c.pairs, c.confirmed, c.touching, c.faces, c.colors};
}

inline std::vector<StepSeen> step_by_step(Pipeline& pipeline, float dt_s, std::uint64_t steps) {
  std::vector<StepSeen> seen;
  for (std::uint64_t k = 0; k < steps; ++k) {
    const core::Status s = pipeline.step(dt_s);
    EXPECT_TRUE(s.ok()) << s.error().line();
    seen.push_back(seen_by(pipeline));
  }
  return seen;
}

inline std::vector<StepSeen> run_ahead(Pipeline& pipeline, float dt_s, std::uint64_t steps) {
  std::vector<StepSeen> seen;
  const core::Status s = pipeline.run(dt_s, steps, [&] {
    seen.push_back(seen_by(pipeline));
    double all_s = 0.0;
    for (const core::StageTime& stage : pipeline.stage_times()) {
      EXPECT_GE(stage.seconds, 0.0) << stage.stage;
      all_s += stage.seconds;
    }
    EXPECT_LT(all_s, 60.0) << "the clocks are of one frame";
    return true;
  });
  EXPECT_TRUE(s.ok()) << s.error().line();
  return seen;
}

inline void expect_same_frame(Pipeline& a, Pipeline& b) {
  core::FrameRecord p;
  core::FrameRecord q;
  ASSERT_TRUE(a.read_back(p, core::RecordLevel::kFull).ok());
  ASSERT_TRUE(b.read_back(q, core::RecordLevel::kFull).ok());
  EXPECT_EQ(p.step, q.step);
  EXPECT_EQ(p.time_s, q.time_s);
  EXPECT_EQ(p.digest, q.digest) << first_difference(p, q);
}

// Returns how many frames were repeated in the run.
inline std::uint64_t expect_same_steps(const core::Scene& scene, const PipelineOptions& options, std::uint64_t steps) {
  Pipeline ahead(options);
  Pipeline one_by_one(options);
  EXPECT_TRUE(ahead.load(scene).ok());
  EXPECT_TRUE(one_by_one.load(scene).ok());
  const std::vector<StepSeen> expected = step_by_step(one_by_one, scene.dt_s, steps);
  EXPECT_EQ(run_ahead(ahead, scene.dt_s, steps), expected);
  EXPECT_EQ(ahead.repeated_frames(), one_by_one.repeated_frames());
  expect_same_frame(ahead, one_by_one);
  return ahead.repeated_frames();
}

inline PipelineOptions boxes_alone() {
  PipelineOptions options;
  options.has_vertex_stage = false;
  options.levels = core::Levels::kFlat;
  return options;
}

inline void expect_same_steps_of_every_start(const core::Scene& scene, std::uint64_t steps) {
  for (const Broad broad : {Broad::kTree, Broad::kOctree, Broad::kHash, Broad::kBrute}) {
    for (const Solver solver : {Solver::kColored, Solver::kJacobi}) {
      SCOPED_TRACE(static_cast<int>(broad) * 10 + static_cast<int>(solver));
      PipelineOptions options;
      options.broad = broad;
      options.solver = solver;
      options.levels = core::Levels::kA;
      options.least_for_grid = 10;
      expect_same_steps(scene, options, steps);
    }
  }
}

// Small boxes without gravity.
inline core::Scene floating_boxes(std::uint32_t bodies) {
  SceneShape shape;
  shape.bodies = bodies;
  shape.gravity_m_s2 = 0.0F;
  core::Scene scene = thrown({box_mesh({0.02F, 0.02F, 0.02F})}, shape);
  scene.dt_s = 0.01F;
  scene.domain = {{-9, -9, -9}, {9, 9, 9}};
  return scene;
}

// Bodies that start apart from each other and fly to one point, which all reach after so many steps: few pairs at
// first, then every pair.
inline core::Scene flying_together(std::uint32_t bodies, float steps) {
  core::Scene scene = floating_boxes(bodies);
  for (core::Body& body : scene.bodies) {
    body.position = (1.0F / core::length(body.position)) * body.position;
    body.velocity = (-1.0F / (steps * scene.dt_s)) * body.position;
  }
  return scene;
}

// Bodies in a lattice, none near another, which all leave the domain over one corner after so many steps, so that each
// meets three faces.
inline core::Scene flying_out(std::uint32_t bodies, float steps) {
  core::Scene scene = floating_boxes(bodies);
  const float speed_m_s = 9.0F / (steps * scene.dt_s);
  for (std::uint32_t i = 0; i < bodies; ++i) {
    scene.bodies[i].position =
        0.1F * core::Vec3{static_cast<float>(i % 10), static_cast<float>(i / 10 % 10), static_cast<float>(i / 100)};
    scene.bodies[i].velocity = {speed_m_s, speed_m_s, speed_m_s};
  }
  scene.parameters.v_max_m_s = 2.0F * speed_m_s;
  return scene;
}

}  // namespace broadside::gpu
