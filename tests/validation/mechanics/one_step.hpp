// Recordings of one step of a body or two, written by hand: the verdict of a law of mechanics just inside its limit and
// just outside of it. The step is 1/64 s and gravity 8 m/s^2 downward, so that no number rounds.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/mutants/specimen.hpp"
#include "core/scene/scene.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::tests {

constexpr double kStep = 0x1p-6;  // s
constexpr double kG = 8.0;        // m/s^2
// Unit roundoff of float32. The states below are doubles, and declared to be results of float32.
constexpr double kU = 0x1p-24;

inline std::shared_ptr<const core::Mesh> unit_box(double x = 1.0, double y = 1.0, double z = 1.0) {
  return std::make_shared<const core::Mesh>(std::move(datasets::box_mesh({x, y, z}, {1, 1, 1})).value());
}
inline std::shared_ptr<const core::Mesh> ball(double radius) {
  return std::make_shared<const core::Mesh>(std::move(datasets::sphere_mesh(radius, 6)).value());
}

// Bodies of 1 kg with the moments (kg m^2) about their mesh axes, far from every face of the domain unless moved there.
inline bench::Specimen one_step(std::size_t bodies, std::vector<double> moments = {1.0, 1.0, 1.0}) {
  bench::Specimen r;
  core::Scene& scene = r.header.scene;
  scene.name = "one step";
  scene.meshes = {unit_box()};
  scene.domain = {{-64, -64, -64}, {64, 64, 64}};
  scene.gravity_m_s2 = {0, -static_cast<float>(kG), 0};
  scene.dt_s = static_cast<float>(kStep);
  scene.motion = core::Motion::kRigid;
  scene.parameters.delta_m = 0.0F;
  scene.bodies.resize(bodies);
  for (core::Body& b : scene.bodies) b.material = {0.5F, 0.5F, 0.0F};
  scene.face_material = {0.5F, 0.5F, 0.0F};
  core::MassProperties mass;
  mass.center_of_mass_m = {0, 0, 0};
  mass.inertia_kg_m2 = {moments[0], moments[1], moments[2], 0, 0, 0};
  scene.mass_properties.assign(bodies, mass);
  r.header.declaration = core::Declaration::of({{"precision", "f32"}, {"detection_at", "start"}});
  r.header.groups = core::bit(core::Group::kBodies) | core::bit(core::Group::kWideBodies);
  return r;
}

// Sets the end of the step to the start with `change` applied to it; change(core::WideStates&).
template <typename Change>
core::FrameRecord& end_step(bench::Specimen& r, const Change& change) {
  core::FrameRecord& frame = r.frames.emplace_back();
  frame.step = 1;
  frame.time_s = kStep;
  for (const core::Body& b : r.header.scene.bodies) {
    frame.wide.position.push_back({b.position.x, b.position.y, b.position.z});
    frame.wide.velocity.push_back({b.velocity.x, b.velocity.y, b.velocity.z});
    frame.wide.angular_velocity.push_back({b.angular_velocity.x, b.angular_velocity.y, b.angular_velocity.z});
    frame.wide.orientation.push_back({b.orientation.w, b.orientation.x, b.orientation.y, b.orientation.z});
  }
  change(frame.wide);
  for (std::size_t i = 0; i < frame.wide.position.size(); ++i) {
    frame.position.push_back(core::narrowed(frame.wide.position[i]));
    frame.velocity.push_back(core::narrowed(frame.wide.velocity[i]));
    frame.angular_velocity.push_back(core::narrowed(frame.wide.angular_velocity[i]));
    frame.orientation.push_back(core::narrowed(frame.wide.orientation[i]));
  }
  return frame;
}

inline void add_point(bench::Specimen& r, const core::ContactPoint& p) {
  r.header.groups |= core::bit(core::Group::kPoints);
  r.frames.back().points.push_back(p);
}

inline core::Verdict law(const std::string& name, const bench::Specimen& r) {
  auto verdicts = bench::judge_specimen(r, nullptr, {name});
  EXPECT_TRUE(verdicts.ok()) << (verdicts.ok() ? "" : verdicts.error().line());
  return verdicts.ok() && verdicts.value().size() == 1 ? verdicts.value()[0] : core::Verdict{};
}

inline std::string told(const core::Verdict& v) {
  return v.validator + ": " + std::string(core::outcome_word(v.outcome)) + ": " + v.explanation + " [" + v.origin + "]";
}

// make(value): a recording in which the judged value is that, and nothing else is wrong. It passes at 0.9 of the limit
// and fails at 1.1 of it, and the verdict names this limit and shows the parts of a worked line.
template <typename Make>
void expect_limit(const std::string& name, double limit, const Make& make, const std::vector<std::string>& parts = {}) {
  const core::Verdict inside = law(name, make(0.9 * limit));
  EXPECT_EQ(inside.outcome, core::Outcome::kPass) << told(inside);
  const core::Verdict outside = law(name, make(1.1 * limit));
  EXPECT_EQ(outside.outcome, core::Outcome::kFail) << told(outside);
  EXPECT_NEAR(outside.limit, limit, 0.02 * limit) << told(outside);
  EXPECT_FALSE(outside.origin.empty());
  for (const std::string& part : parts)
    EXPECT_NE(outside.explanation.find(part), std::string::npos) << "no '" << part << "' in: " << outside.explanation;
}

inline void expect_nothing_met(const std::string& name, const bench::Specimen& r, const std::string& why) {
  const core::Verdict v = law(name, r);
  EXPECT_EQ(v.outcome, core::Outcome::kNotApplicable) << told(v);
  EXPECT_NE(v.explanation.find(why), std::string::npos) << told(v);
}

// One static body: nothing can move.
inline bench::Specimen only_static() {
  bench::Specimen r = one_step(1);
  r.header.scene.bodies[0].inverse_mass = 0.0F;
  end_step(r, [](core::WideStates&) {});
  return r;
}

}  // namespace broadside::tests
