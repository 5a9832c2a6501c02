// No false alarms: the sound engine on random scenes, with masses, materials, parameters and places far apart, is
// blamed by nobody. What the limits allow must cover every rounding that a right engine makes.
#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

using bench::random_scene;

void expect_no_blame(const core::Scene& scene, const EngineSettings& settings, unsigned seed) {
  const core::Status status = core::check_scene(scene);
  ASSERT_TRUE(status.ok()) << status.error().line();
  const Recording recording = record(scene, settings);
  std::size_t contacts = 0;
  for (const FrameRecord& frame : recording.frames) contacts += frame.contacts.size();
  ASSERT_GT(contacts, 20u) << "seed " << seed << " shows too little";
  for (const core::Verdict& v : judged(recording))
    EXPECT_TRUE(v.outcome == core::Outcome::kPass || v.outcome == core::Outcome::kNotApplicable)
        << "seed " << seed << ": " << line(v);
}

TEST(RandomScenes, AreNotBlamed) {
  for (unsigned seed = 0; seed < 40; ++seed) expect_no_blame(random_scene(seed, -2.0F, 10.0F), {}, seed);
}

TEST(RandomScenes, AreNotBlamedWithoutTheOrderOfColors) {
  for (unsigned seed = 100; seed < 120; ++seed)
    expect_no_blame(random_scene(seed, -2.0F, 10.0F), {{"solver", "jacobi"}}, seed);
}

// Positions of 1000 m: one spacing of float is 0.06 mm there.
TEST(RandomScenes, AreNotBlamedFarFromTheOrigin) {
  for (unsigned seed = 200; seed < 220; ++seed) expect_no_blame(random_scene(seed, 1000.0F, 10.0F), {}, seed);
}

TEST(RandomScenes, AreNotBlamedForMassesAMillionTimesApart) {
  for (unsigned seed = 300; seed < 320; ++seed) expect_no_blame(random_scene(seed, -2.0F, 1e6F), {}, seed);
}

}  // namespace
}  // namespace broadside::tests
