// How ode-world reports contacts of ODE that no step can begin with.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/engine/engine.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

// In ODE, the stones of an arch of 25 touch in the first step with a normal of length zero, which would make states
// that are NaN.
TEST(OdeWorld, SaysWhichBodiesGotAContactWithoutADirection) {
  const core::EngineRow row = reference::ode_world_row();
  if (!row.absent().empty()) GTEST_SKIP() << row.absent();
  const auto scenes = datasets::rigid_scenes();
  const auto arch = std::find_if(scenes.begin(), scenes.end(),
                                 [](const auto& scene) { return std::string(scene.name) == "rigid:arch:25-stands"; });
  ASSERT_NE(arch, scenes.end());
  const core::Scene scene = arch->make();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  ASSERT_TRUE(engine.ok());
  ASSERT_TRUE(engine.value().dynamics->load(scene).ok());
  const core::Status stepped = engine.value().dynamics->step(scene.dt_s);
  ASSERT_FALSE(stepped.ok());
  EXPECT_NE(stepped.error().line().find("without a direction, between body 10 and body 11"), std::string::npos)
      << stepped.error().line();
  EXPECT_EQ(stepped.error().exit, core::Exit::kMissing);
}

}  // namespace
}  // namespace broadside
