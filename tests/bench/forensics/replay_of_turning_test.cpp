// replay of an engine whose bodies turn: a right one agrees within what both declare, a wrong one is found.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "core/trace/trace_writer.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "tests/bench/cli/program.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::tests {
namespace {

using validation::Mat3d;
using validation::Quatd;
using validation::Vec3d;

constexpr std::uint32_t kSteps = 40;
constexpr float kStep_s = 1.0F / 240.0F;

// A brick that flies and tumbles; it reaches the floor after `drop_m`.
core::Scene tumbling_brick(float drop_m) {
  core::Scene scene;
  scene.name = "test:tumbling-brick";
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({0.2, 0.4, 0.8}, {1, 1, 1}).value())};
  scene.domain = {{-10, 0, -10}, {10, 20, 10}};
  scene.gravity_m_s2 = {0, -10, 0};
  scene.dt_s = kStep_s;
  scene.frames = kSteps;
  scene.motion = core::Motion::kRigid;
  scene.bodies.resize(1);
  scene.bodies[0].position = {0, 0.2F + drop_m, 0};
  scene.bodies[0].velocity = {1, 0, 0};
  scene.bodies[0].angular_velocity = {0.2F, 3.0F, 0.1F};
  return scene;
}

// Faults that an engine made by others may have.
struct Fault {
  double gravity = 1.0;
  double turning = 1.0;
  double spin_a_step = 1.0;
};

// The brick in free flight by an engine of its own: the exact parabola, the angular momentum kept, and the orientation
// by the midpoint rule. It never meets the floor.
std::vector<core::FrameRecord> flown(const core::Scene& scene, const Fault& fault) {
  const validation::BodyFacts facts = validation::facts_of(scene)[0];
  const double h = scene.dt_s;
  const double g = fault.gravity * scene.gravity_m_s2.y;
  Vec3d x(scene.bodies[0].position);
  Vec3d v(scene.bodies[0].velocity);
  Quatd q = validation::to_quatd(scene.bodies[0].orientation);
  const Vec3d& I{facts.inertia.row[0].x, facts.inertia.row[1].y, facts.inertia.row[2].z};
  const auto spin_of = [&](Quatd at, Vec3d momentum) {
    const Mat3d r = validation::matrix_of(at);
    const Vec3d local = validation::transposed_times(r, momentum);
    return r * Vec3d{local.x / I.x, local.y / I.y, local.z / I.z};
  };
  const Vec3d w0(scene.bodies[0].angular_velocity);
  Vec3d momentum{I.x * w0.x, I.y * w0.y, I.z * w0.z};
  std::vector<core::FrameRecord> frames;
  for (std::uint64_t step = 1; step <= scene.frames; ++step) {
    x = x + Vec3d{h * v.x, h * v.y + 0.5 * h * h * g, h * v.z};
    v.y += h * g;
    momentum = fault.spin_a_step * momentum;
    const Quatd middle = validation::turn_by(0.5 * h * spin_of(q, momentum)) * q;
    q = validation::normalized(validation::turn_by(fault.turning * h * spin_of(middle, momentum)) * q);
    const Vec3d w = spin_of(q, momentum);
    core::FrameRecord frame;
    frame.step = step;
    frame.time_s = static_cast<double>(step) * h;
    const auto narrow = [](Vec3d a) {
      return core::Vec3{static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
    };
    frame.position = {narrow(x)};
    frame.velocity = {narrow(v)};
    frame.angular_velocity = {narrow(w)};
    frame.orientation = {
        {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)}};
    frames.push_back(frame);
  }
  return frames;
}

class ReplayOfTurning : public testing::Test {
 protected:
  std::string written(const core::Scene& scene, const Fault& fault, const std::string& name,
                      const std::map<std::string, std::string>& declared = {{"motion", "rigid"},
                                                                            {"order", "2"}}) const {
    core::TraceHeader header;
    header.stamp.scene_name = scene.name;
    header.stamp.scene_digest = core::scene_digest(scene);
    header.stamp.engine = "somebody-elses";
    header.declaration = core::Declaration::of(declared);
    header.scene = scene;
    header.groups = core::bit(core::Group::kBodies);
    const auto file = folder_ / (name + ".h5");
    auto writer = core::TraceWriter::create(file, header);
    EXPECT_TRUE(writer.ok()) << (writer.ok() ? "" : writer.error().line());
    for (const core::FrameRecord& frame : flown(scene, fault)) EXPECT_TRUE(writer.value().append(frame).ok());
    EXPECT_TRUE(writer.value().finish().ok());
    return file.string();
  }

  static Ended replayed(const std::string& trace) { return run_program({"replay", trace, "--engine", "plain-rigid"}); }

  const ScratchFolder folder_;
};

TEST_F(ReplayOfTurning, TwoRightEnginesAgreeInAllSteps) {
  const Ended ended = replayed(written(tumbling_brick(5.0F), {}, "right"));
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("40 states judged"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("somebody-elses: order 2"), std::string::npos) << ended.out;
}

TEST_F(ReplayOfTurning, GravityOffByATenthIsFoundInTheFirstStep) {
  const Ended ended = replayed(written(tumbling_brick(5.0F), {.gravity = 1.1}, "gravity"));
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("First difference: step 1, body 0, /trace/body/velocity.y"), std::string::npos) << ended.out;
}

TEST_F(ReplayOfTurning, AnOrientationAtHalfRateIsFound) {
  const Ended ended = replayed(written(tumbling_brick(5.0F), {.turning = 0.5}, "half-rate"));
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("/trace/body/orientation"), std::string::npos) << ended.out;
}

TEST_F(ReplayOfTurning, ASpinThatGrowsIsFound) {
  const Ended ended = replayed(written(tumbling_brick(5.0F), {.spin_a_step = 1.01}, "spin-up"));
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("First difference: step 1, body 0, /trace/body/"), std::string::npos) << ended.out;
}

// The other engine never meets the floor, which ours does: from there on their motions must differ, and neither is
// called wrong.
TEST_F(ReplayOfTurning, FromTheFirstTouchOnNothingIsJudged) {
  const Ended ended = replayed(written(tumbling_brick(0.05F), {}, "touch"));
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("1 of 1 bodies were touched"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("motions must differ there"), std::string::npos) << ended.out;
}

// An engine that declares order 1 may be off by h^2 g / 2 in position a step; where both declare order 2 this is a
// fault.
TEST_F(ReplayOfTurning, AnEngineOfOrderOneMayTruncateAndOneOfAnotherOrderMayNot) {
  core::Scene scene = tumbling_brick(5.0F);
  scene.bodies[0].angular_velocity = {};
  const Ended two = replayed(written(scene, {}, "two", {{"motion", "rigid"}, {"order", "2"}}));
  EXPECT_EQ(two.exit_code, 0) << two.out;
  const Ended one = replayed(written(scene, {}, "one", {{"motion", "rigid"}, {"order", "1"}}));
  EXPECT_EQ(one.exit_code, 0) << one.out;
}

}  // namespace
}  // namespace broadside::tests
