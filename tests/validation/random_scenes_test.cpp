// No false alarms: no validator rejects the sound engine on random scenes, with masses, materials, parameters and
// places far apart. The limits must cover every rounding that a right engine makes.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

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

// A limit that rounding never comes near would be a guess. So for each law with a derived limit, some contact of some
// scene must use a good part of it. (Limits that are sums of worst cases, as for energy, are nearly reached only in
// small scenes.)
TEST(RandomScenes, UseAGoodPartOfTheLimits) {
  std::map<std::string, double> most;
  for (unsigned seed = 0; seed < 40; ++seed)
    for (const core::Verdict& v : judged(record(random_scene(seed, -2.0F, 10.0F), {})))
      if (v.limit > 0.0) most[v.validator] = std::max(most[v.validator], v.measured / v.limit);
  const std::map<std::string, double> wanted{{"contraction", 0.1},    {"center-of-mass", 0.1},   {"restitution", 0.05},
                                             {"normal-energy", 0.05}, {"friction-energy", 0.05}, {"state-sanity", 0.5},
                                             {"energy", 0.01}};
  for (const auto& [validator, share] : wanted) {
    EXPECT_GE(most[validator], share) << validator;
    EXPECT_LE(most[validator], 1.0) << validator;
    RecordProperty(validator, std::to_string(most[validator]));
    std::printf("%s: %.3f of its limit\n", validator.c_str(), most[validator]);
  }
}

}  // namespace
}  // namespace broadside::tests
