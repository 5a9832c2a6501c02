// The ledger's terms against closed forms, and the ledgers of whole runs.
#include "validation/energy_ledger.hpp"

#include <cmath>

#include "tests/validation/engine_recording.hpp"

namespace broadside::tests {
namespace {

Recording alone_under_gravity() {
  core::Scene scene = named_scene("two-body:apart");
  scene.gravity_m_s2 = {0.0F, -9.81F, 0.0F};
  scene.bodies[0].inverse_mass = 0.25F;
  scene.frames = 10;
  return record(scene, {});
}

// v' = v + dt g, x' = x + dt v': kinetic energy gains m (v dt g + dt^2 g^2 / 2), gravity takes m g dt (v + dt g).
TEST(EnergyLedger, SemiImplicitEulerLosesHalfOfMDt2G2AStepInFreeFall) {
  const Recording r = alone_under_gravity();
  const validation::EnergyLedger ledger(r.header.scene);
  const double dt = r.header.scene.dt_s;
  const double g = 9.81F;
  const double expected = -0.5 * (4.0 + 1.0) * dt * dt * g * g;
  for (std::size_t k = 0; k < r.frames.size(); ++k) {
    const auto row = ledger.row(r.frames[k], k == 0 ? nullptr : &r.frames[k - 1]);
    ASSERT_TRUE(row.has_value());
    EXPECT_NEAR(row->integration, expected, 1e-9);
    EXPECT_EQ(row->normal + row->friction + row->correction + row->clip, 0.0);
    EXPECT_NEAR(row->change, expected, row->rounding);
    EXPECT_LT(row->rounding, 1e-3) << "the bound says nothing";
  }
}

// Equal cubes meet head on at 2 m/s with e = 0.3: m v^2 (e^2 - 1) of both, without gravity nothing else.
TEST(EnergyLedger, ABounceTakesWhatRestitutionSays) {
  const Recording r = record(named_scene("two-body:head-on"), {});
  const validation::EnergyLedger ledger(r.header.scene);
  double normal = 0.0;
  double rest = 0.0;
  for (std::size_t k = 1; k < r.frames.size(); ++k) {
    const auto row = ledger.row(r.frames[k], &r.frames[k - 1]);
    ASSERT_TRUE(row.has_value());
    normal += row->normal;
    rest += std::abs(row->integration) + std::abs(row->friction) + std::abs(row->correction) + std::abs(row->clip);
  }
  EXPECT_NEAR(normal, 0.3 * 0.3 - 1.0, 1e-6);
  EXPECT_NEAR(rest, 0.0, 1e-6);
}

TEST(EnergyLedger, FramesThatDoNotFollowEachOtherHaveNoRow) {
  const Recording r = alone_under_gravity();
  const validation::EnergyLedger ledger(r.header.scene);
  EXPECT_FALSE(ledger.row(r.frames[5], &r.frames[3]).has_value());
  EXPECT_FALSE(ledger.row(r.frames[5], nullptr).has_value());
  FrameRecord bare;
  bare.step = 1;
  EXPECT_FALSE(ledger.row(bare, nullptr).has_value());
}

// Work of every kind that the ledger does not record.
TEST(EnergyLedger, UnbookedWorkBreaksTheBooks) {
  EXPECT_EQ(verdict_of("energy", sound()).outcome, core::Outcome::kPass) << line(verdict_of("energy", sound()));
  Recording wrong = sound();
  wrong.frames[20].velocity[5].y *= 1.001F;
  EXPECT_EQ(verdict_of("energy", wrong).outcome, core::Outcome::kFail);
  wrong = sound();
  wrong.frames[20].position[5].y += 1e-3F;
  EXPECT_EQ(verdict_of("energy", wrong).outcome, core::Outcome::kFail);
}

}  // namespace
}  // namespace broadside::tests
