// No false alarms: the sound engine on random scenes, with masses, materials, parameters and places far apart, is
// blamed by nobody. What the limits allow must cover every rounding that a right engine makes.
#include <random>

#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

core::Scene random_scene(unsigned seed, float origin_m, float largest_mass_ratio) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  core::Scene scene;
  scene.name = "random";
  scene.meshes = {grid_cube(4)};
  const Vec3 low{origin_m, origin_m, origin_m};
  scene.domain = {low, low + Vec3{4, 4, 4}};
  scene.gravity_m_s2 = {uniform(-2, 2), uniform(-10, 0), uniform(-2, 2)};
  scene.dt_s = uniform(0.002F, 0.02F);
  scene.frames = 60;
  core::Parameters& p = scene.parameters;
  p.beta = uniform(0.3F, 1.0F);
  p.alpha = uniform(0.3F, 1.0F);
  p.delta_m = uniform(0.0F, 0.02F);
  p.impulse_min_n_s = uniform(0.0F, 0.1F);
  p.v_threshold_m_s = uniform(0.0F, 1.0F);
  p.v_max_m_s = uniform(2.0F, 20.0F);
  const auto material = [&] {
    const float mu = uniform(0.0F, 1.0F);
    return core::Material{mu, mu * uniform(0.0F, 1.0F), uniform(0.0F, 1.0F)};
  };
  scene.face_material = material();
  for (int k = 0; k < 12; ++k) {
    core::Body body = body_at(low + Vec3{uniform(0.6F, 3.4F), uniform(0.6F, 3.4F), uniform(0.6F, 3.4F)},
                              {uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)},
                              std::exp(uniform(0.0F, std::log(largest_mass_ratio))));
    if (k % 6 == 5) body = body_at(body.position, {}, 0.0F);
    body.material = material();
    scene.bodies.push_back(body);
  }
  return scene;
}

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
