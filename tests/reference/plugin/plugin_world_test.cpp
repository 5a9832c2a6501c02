// Dynamics engines of version 2 from shared libraries: everything that sound ones give arrives, and each kind of false
// answer is one clear line.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "core/engine/engine.hpp"
#include "datasets/scenes.hpp"
#include "reference/plugin/plugin_engine.hpp"
#include "reference/plugin/plugin_scene2.hpp"

namespace broadside {
namespace {

const std::string kWorldFolder = BROADSIDE_PLUGIN_DIR;

core::Scene scene(const std::string& spec) {
  auto made = datasets::make_scene(spec, {});
  EXPECT_TRUE(made.ok()) << made.error().line();
  return std::move(made).value();
}

core::Result<core::Engine> wrong_world(int fault, int sweeps = 3) {
  static const std::array rows{core::SettingRow{"fault", "0", {}, "what is wrong"},
                               core::SettingRow{"sweeps", "3", {}, "what it declares"}};
  auto settings = core::Settings::parse("wrong-world", rows,
                                        {{"fault", std::to_string(fault)}, {"sweeps", std::to_string(sweeps)}});
  return reference::create_plugin_engine(kWorldFolder + "/libwrong_world.so", settings.value(),
                                         core::make_host_space());
}

// One step of free cubes; what went wrong, or "sound".
std::string world_outcome(int fault) {
  static const core::Scene cubes = scene("freefall:cube:3");
  auto engine = wrong_world(fault);
  if (!engine) return engine.error().line();
  core::Dynamics& dynamics = *engine.value().dynamics;
  core::FrameRecord frame;
  core::Status status = dynamics.load(cubes);
  if (status.ok()) status = dynamics.step(cubes.dt_s);
  if (status.ok()) status = dynamics.read_back(frame, core::RecordLevel::kFull);
  return status.ok() ? "sound" : status.error().line();
}

TEST(PluginWorld, EachLieIsOneClearLine) {
  const auto says = [](int fault, const std::string& words) {
    const std::string line = world_outcome(fault);
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(line.find(words), std::string::npos) << fault << ": " << line;
  };
  says(0, "sound");
  says(1, "read_points: it claims to have 1152921504606846976 rows");
  says(2, "read_points: it reports 1 rows, but did not write number 0");
  says(3, "read_points: it has 258 rows now, but had 257 a call before");
  says(4, "point number 0 has an impulse that is NaN or infinite");
  says(5, "point number 0 is between 0 and 3, and there are 3 bodies");
  says(6, "point number 0 is between 0 and 0");
  says(7, "read_states: it did not write body 0 of 3");
  says(8, "read_detection: it did not write body 0 of 3");
  says(9, "read_step_pairs: pair number 0 is (0, 3), and a pair has i < j < 3");
  says(10, "wrong-world: step: the moon is  [31mfull?");
  says(11, "begin: unsupported: box");
  says(13, "has a place, a normal or a gap that is NaN or infinite");
}

TEST(PluginWorldDeathTest, AWriteBehindTheStatesEndsTheProcess) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_DEATH(world_outcome(12), "");
}

TEST(PluginWorld, StatesArriveInFloat64) {
  const core::Scene cubes = scene("freefall:cube:3");
  auto engine = wrong_world(0);
  ASSERT_TRUE(engine.ok()) << engine.error().line();
  EXPECT_EQ(engine.value().declaration.text("contacts"), "totals");
  core::Dynamics& dynamics = *engine.value().dynamics;
  EXPECT_EQ(dynamics.groups(), bit(core::Group::kBodies) | bit(core::Group::kWideBodies) | bit(core::Group::kPoints) |
                                   bit(core::Group::kDetection) | bit(core::Group::kDetectedOrientation) |
                                   bit(core::Group::kPairs));
  ASSERT_TRUE(dynamics.load(cubes).ok());
  ASSERT_TRUE(dynamics.step(cubes.dt_s).ok());
  core::FrameRecord frame;
  ASSERT_TRUE(dynamics.read_back(frame, core::RecordLevel::kFull).ok());
  const double h = cubes.dt_s;
  const double v0 = cubes.bodies[1].velocity.y;
  const double g = cubes.gravity_m_s2.y;
  EXPECT_DOUBLE_EQ(frame.wide.velocity[1].y, v0 + h * g);
  EXPECT_DOUBLE_EQ(frame.wide.position[1].y, cubes.bodies[1].position.y + h * (v0 + 0.5 * h * g));
  EXPECT_EQ(frame.position[1], core::narrowed(frame.wide.position[1]));
  EXPECT_EQ(frame.detected_position[1], cubes.bodies[1].position) << "of the start of the step";
  EXPECT_EQ(frame.boxes.size(), 3U);
}

// A declared value that depends on a setting follows that setting; otherwise a law would judge by a value that no
// longer holds.
TEST(PluginWorld, ASettingMayBeDeclared) {
  EXPECT_EQ(wrong_world(0).value().declaration.number("iterations"), 3.0);
  EXPECT_EQ(wrong_world(0, 16).value().declaration.number("iterations"), 16.0);
}

TEST(PluginWorld, TablesOfOtherHeadersAreRefusedOrRead) {
  const auto described = [](const std::string& name) {
    const auto description = reference::describe_plugin(kWorldFolder + "/libworld_" + name + ".so");
    return description.ok() ? "accepted: " + description.value().capabilities : description.error().line();
  };
  EXPECT_EQ(described("larger"), "accepted: dynamics") << "functions that a later header appends are not looked at";
  EXPECT_NE(described("too_small").find("its table has 64 bytes"), std::string::npos);
  EXPECT_NE(described("of_version_3").find("it speaks version 3"), std::string::npos);
  EXPECT_NE(described("unknown_word").find("'friction' cannot be declared as 'con'; did you mean 'cone'?"),
            std::string::npos);
  EXPECT_NE(described("unknown_key").find("a declaration has no key 'frictoin'"), std::string::npos);
  EXPECT_NE(described("unknown_setting").find("'substeps' by the setting 'sweeps', which it does not have"),
            std::string::npos);
  EXPECT_NE(described("declared_twice").find("it declares 'order' twice"), std::string::npos);
  EXPECT_NE(described("no_points").find("declares contacts = totals but has no read_points"), std::string::npos);
  EXPECT_NE(described("no_text").find("build or what is not one line"), std::string::npos);
  EXPECT_NE(described("half_world").find("only some functions of a dynamics engine"), std::string::npos);
}

// A library of version 1 declares nothing: the laws of METHOD are applied to it, as before there were declarations.
TEST(PluginWorld, ALibraryOfVersion1WorksAsBefore) {
  auto settings = core::Settings::parse("falling", {}, {});
  auto engine = reference::create_plugin_engine(kWorldFolder + "/libfalling_engine.so", settings.value(),
                                                core::make_host_space());
  ASSERT_TRUE(engine.ok()) << engine.error().line();
  EXPECT_EQ(engine.value().declaration, core::method_declaration());
  core::Dynamics& dynamics = *engine.value().dynamics;
  EXPECT_EQ(dynamics.groups(), bit(core::Group::kBodies));
  core::Scene cubes = scene("freefall:cube:3");
  ASSERT_TRUE(dynamics.load(cubes).ok());
  ASSERT_TRUE(dynamics.step(cubes.dt_s).ok());
  core::FrameRecord frame;
  ASSERT_TRUE(dynamics.read_back(frame, core::RecordLevel::kFull).ok());
  EXPECT_EQ(frame.velocity[2].y, cubes.bodies[2].velocity.y + cubes.dt_s * cubes.gravity_m_s2.y);

  cubes.motion = core::Motion::kRigid;
  const core::Status refused = dynamics.load(cubes);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().line().find("version 1 of the interface gives no inertia; export broadside_engine_v2"),
            std::string::npos)
      << refused.error().line();
}

TEST(PluginWorld, WhereALibraryHasBothVersionsTheSecondIsUsed) {
  const auto both = reference::describe_plugin(kWorldFolder + "/libfalling_both.so");
  ASSERT_FALSE(both.ok());
  EXPECT_NE(both.error().line().find("broadside_engine_v2 returned null"), std::string::npos) << both.error().line();
}

// Expected values are the example's own numbers: a brick of 2 kg, 0.2 x 0.4 x 0.6 m, and a ball of 0.25 m.
TEST(PluginScene, SaysShapesMassesAndThresholds) {
  const std::string examples = std::string(BROADSIDE_SOURCE_DIR) + "/core/plugin/examples/";
  const core::Scene given = scene(examples + "spinning_box.toml");
  const auto made = reference::PluginScene2::of(given);
  ASSERT_TRUE(made.ok()) << made.error().line();
  const broadside_scene2& c = *made.value()->c_struct();
  EXPECT_EQ(c.motion, static_cast<std::uint32_t>(BROADSIDE_RIGID));
  EXPECT_EQ(c.shapes[0].kind, static_cast<std::uint32_t>(BROADSIDE_BOX));
  EXPECT_FLOAT_EQ(static_cast<float>(c.shapes[0].half_extents[2]), 0.3F);
  EXPECT_DOUBLE_EQ(c.bodies[0].mass, 2.0);
  const double tolerance = 2.0 * 0x1p-23;  // sides are float32
  EXPECT_NEAR(c.bodies[0].inertia[0], 2.0 * (0.4 * 0.4 + 0.6 * 0.6) / 12.0, tolerance);
  EXPECT_NEAR(c.bodies[0].inertia[1], 2.0 * (0.2 * 0.2 + 0.6 * 0.6) / 12.0, tolerance);
  EXPECT_EQ(c.bodies[0].inertia[3], 0.0);
  EXPECT_EQ(c.v_threshold, given.parameters.v_threshold_m_s);
  EXPECT_EQ(c.delta, given.parameters.delta_m);

  const core::Scene ball = scene(examples + "rolling_ball.toml");
  const auto rolling = reference::PluginScene2::of(ball);
  ASSERT_TRUE(rolling.ok()) << rolling.error().line();
  const broadside_shape& sphere = rolling.value()->c_struct()->shapes[0];
  EXPECT_EQ(sphere.kind, static_cast<std::uint32_t>(BROADSIDE_SPHERE));
  EXPECT_EQ(sphere.radius, 0.25);
  EXPECT_EQ(sphere.half_length, 0.0);
}

}  // namespace
}  // namespace broadside
