// Contact solvers of the turning candidate, by the laws of mechanics: expected values are closed forms.
#include "reference/octree_cpu/rigid/contact_solver.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "tests/reference/octree_cpu/rigid/box_rig.hpp"

namespace broadside::reference {
namespace {

using core::Vec3;

constexpr float kReach_m = 0.05F;
constexpr double kG = 9.81;

core::Quat unit(core::Quat q) {
  return (1.0F / std::sqrt(core::dot(q, q))) * q;
}

class ContactSolvers : public testing::TestWithParam<SolverKind> {
 protected:
  [[nodiscard]] std::unique_ptr<ContactSolver> solver() const { return make_contact_solver({.kind = GetParam()}); }
};

// A pillar of unit cubes.
BoxRig pillar(int count, float top_mass_kg) {
  BoxRig rig;
  for (int k = 0; k < count; ++k)
    rig.add({0.5F, 0.5F, 0.5F}, {0.0F, 0.5F + static_cast<float>(k), 0.0F}, k + 1 == count ? top_mass_kg : 1.0F,
            {0.5F, 0.5F, 0.0F});
  return rig;
}

void step_pillar(BoxRig& rig, ContactSolver& solver) {
  rig.patches.clear();
  rig.meet_floor(0, kReach_m);
  for (std::uint32_t k = 1; k < rig.states.size(); ++k) rig.meet_top(k, k - 1, kReach_m);
  rig.step(solver);
}

void step_on_floor(BoxRig& rig, ContactSolver& solver, float reach_m = kReach_m) {
  rig.patches.clear();
  for (std::uint32_t k = 0; k < rig.states.size(); ++k) rig.meet_floor(k, reach_m);
  rig.step(solver);
}

TEST_P(ContactSolvers, FreeBodyFallsAndKeepsItsAngularMomentumBitForBit) {
  BoxRig rig;
  rig.add({0.1F, 0.2F, 0.45F}, {0.0F, 100.0F, 0.0F}, 10.0F, {});
  const Vec3 spin{0.3F, 2.5F, -0.1F};
  rig.states[0].angular_momentum = spin;
  const auto solver = this->solver();
  for (int k = 0; k < 120; ++k) rig.step(*solver);
  EXPECT_EQ(rig.states[0].angular_momentum, spin);
  EXPECT_NEAR(rig.states[0].v.y, -kG * 2.0, 2.0 * kG * 120 * 16 * 0x1p-24);  // each substep rounds once
  // The drop lies between those that the speeds at the start and at the end of each step would give.
  EXPECT_NEAR(rig.states[0].x.y, 100.0 - 0.5 * kG * 4.0, 0.5 * kG * 2.0 / 60.0);
}

TEST_P(ContactSolvers, WrenchActsInItsAxes) {
  BoxRig rig;
  rig.add({0.5F, 0.5F, 0.5F}, {}, 2.0F, {});
  rig.gravity_m_s2 = {};
  const std::vector<core::RigidWrench> wrenches{{{4.0F, 0, 0}, {}, {0, 0, 0.5F}, {}}};
  const auto solver = this->solver();
  for (int k = 0; k < 60; ++k) solver->advance(rig.states, {}, {rig.masses, rig.materials, wrenches, {}, {}, rig.dt_s});
  EXPECT_NEAR(rig.states[0].v.x, 2.0, 2.0 * 60 * 16 * 0x1p-24);
  EXPECT_NEAR(rig.states[0].angular_momentum.z, 0.5, 0.5 * 60 * 16 * 0x1p-24);
}

// The floor bears the whole weight, and each interface the weight above it.
TEST_P(ContactSolvers, PillarBearsItsWeight) {
  BoxRig rig = pillar(5, 1.0F);
  const auto solver = this->solver();
  for (int k = 0; k < 300; ++k) step_pillar(rig, *solver);
  ASSERT_EQ(rig.patches.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    double bears = 0.0;
    for (const Vec3 j : solver->impulses()[k]) bears += j.y;
    const double weight = (5.0 - static_cast<double>(k)) * kG / 60.0;
    EXPECT_NEAR(bears, weight, 1e-3 * weight) << "interface " << k;  // rest to a thousandth of gravity
  }
}

TEST_P(ContactSolvers, TwentyCubesStandForAMinuteWithoutCreep) {
  BoxRig rig = pillar(20, 1.0F);
  const auto solver = this->solver();
  std::vector<core::RigidState> settled;
  for (int k = 0; k < 3600; ++k) {
    step_pillar(rig, *solver);
    if (k == 120) settled = rig.states;
    // One percent of the side and a millimeter a body: the law `rest`.
    for (std::size_t i = 0; i < 20; ++i)
      ASSERT_LT(core::length(rig.states[i].x - Vec3{0.0F, 0.5F + static_cast<float>(i), 0.0F}), 0.03F) << "step " << k;
  }
  // RIGID 8: 20 cubes creep by less than 1e-5 of a side a second. The tower sways by some 1e-4 m meanwhile.
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_LT(core::length(rig.states[i].x - settled[i].x), 1e-5 * 58.0) << "cube " << i;
}

// This needs sweeps along conjugate directions: in a soft step the light cube yields.
TEST(ConjugateSolver, HeavyCubeStandsOnALightOne) {
  BoxRig rig = pillar(2, 1000.0F);
  const auto solver = make_contact_solver({});
  for (int k = 0; k < 600; ++k) {
    step_pillar(rig, *solver);
    for (std::size_t i = 0; i < 2; ++i)
      // The law `rest`: one percent of the side and a millimeter a body, and as much again a minute.
      EXPECT_LT(core::length(rig.states[i].x - Vec3{0.0F, 0.5F + static_cast<float>(i), 0.0F}), 0.012) << "step " << k;
  }
}

// Boxes dropped askew: the impulses of the points are what the bodies received.
TEST_P(ContactSolvers, ImpulsesExplainMomentumAndAngularMomentum) {
  BoxRig rig;
  for (int k = 0; k < 6; ++k) {
    const auto i = rig.add({0.2F, 0.3F, 0.4F}, {static_cast<float>(2 * k), 1.0F, 0.0F}, 3.0F, {0.6F, 0.5F, 0.3F});
    const auto t = static_cast<float>(k);
    rig.states[i].q = unit({1.0F, 0.1F * t, 0.05F, -0.07F * t});
    rig.states[i].v = {1.0F - 0.3F * t, -1.0F, 0.2F * t};
    rig.states[i].angular_momentum = {0.05F, 0.02F * t, -0.04F};
  }
  const auto solver = this->solver();
  for (int step = 0; step < 120; ++step) {
    const auto before = rig.states;
    step_on_floor(rig, *solver, 0.5F);
    std::vector<Vec3> momentum(rig.states.size());
    std::vector<Vec3> moment(rig.states.size());
    std::vector<float> size(rig.states.size());
    for (std::size_t k = 0; k < rig.patches.size(); ++k)
      for (int p = 0; p < rig.patches[k].manifold.count; ++p) {
        const std::uint32_t a = rig.patches[k].a;
        const Vec3 j = solver->impulses()[k][static_cast<std::size_t>(p)];
        momentum[a] = momentum[a] + j;
        moment[a] = moment[a] + core::cross(rig.patches[k].manifold.points[p].point, j);
        size[a] += core::length(j);
        // Coulomb's cone, and no pull.
        const float normal = core::dot(j, rig.patches[k].manifold.normal);
        const float across = core::length(j - normal * rig.patches[k].manifold.normal);
        EXPECT_GE(normal, -16 * 0x1p-24F * core::length(j));
        EXPECT_LE(across, 0.6F * normal + 16 * 0x1p-24F * core::length(j));
      }
    for (std::size_t i = 0; i < rig.states.size(); ++i) {
      const float m = 3.0F;
      const Vec3 gained = m * (rig.states[i].v - before[i].v) - (m * rig.dt_s) * rig.gravity_m_s2;
      // Additions in a step: gravity, and four points in three sweeps of each substep.
      const float additions = 16.0F * (1.0F + 3.0F * 4.0F) * 0x1p-24F;
      const float scale = m * (core::length(rig.states[i].v) + core::length(before[i].v)) + size[i] + 0.5F;
      EXPECT_LE(core::length(gained - momentum[i]), additions * scale) << "body " << i << " step " << step;
      const Vec3 turned = rig.states[i].angular_momentum - before[i].angular_momentum;
      const float l = core::length(rig.states[i].angular_momentum) + core::length(before[i].angular_momentum);
      EXPECT_LE(core::length(turned - moment[i]), additions * (l + 0.6F * size[i])) << "body " << i << " step " << step;
    }
  }
}

// v0^2 / (2 mu g) in 16 headings, within 1 % (the order is 1: half a step's way at v0 is 0.5 %).
TEST_P(ContactSolvers, SlidesEquallyFarInEveryHeading) {
  constexpr double kSpeed = 4.0;
  for (int heading = 0; heading < 16; ++heading) {
    BoxRig rig;
    rig.dt_s = 1.0F / 240.0F;
    rig.add({0.5F, 0.125F, 0.5F}, {0.0F, 0.125F, 0.0F}, 1.0F, {0.5F, 0.5F, 0.0F});
    const double angle = heading * 2.0 * 3.14159265358979 / 16.0;
    rig.states[0].v = {static_cast<float>(kSpeed * std::cos(angle)), 0.0F,
                       static_cast<float>(kSpeed * std::sin(angle))};
    const auto solver = this->solver();
    for (int k = 0; k < 300; ++k) step_on_floor(rig, *solver);
    EXPECT_NEAR(std::hypot(rig.states[0].x.x, rig.states[0].x.z) / (kSpeed * kSpeed / (2.0 * 0.5 * kG)), 1.0, 0.01)
        << "heading " << heading;
    EXPECT_LT(core::length(rig.states[0].v), 1e-4F);
  }
}

// A plane that falls with the tangent 1/2, made by tilting gravity: the box slides at g (sin - mu cos), or stays.
TEST_P(ContactSolvers, InclineIsDecidedWithinOnePercent) {
  const double cosine = 1.0 / std::sqrt(1.25);
  for (const double share : {1.0 / 1.01, 1.01}) {
    BoxRig rig;
    rig.dt_s = 1.0F / 240.0F;
    const auto mu = static_cast<float>(0.5 * share);
    rig.add({0.5F, 0.125F, 0.5F}, {0.0F, 0.125F, 0.0F}, 1.0F, {mu, mu, 0.0F});
    rig.gravity_m_s2 = {static_cast<float>(kG * 0.5 * cosine), static_cast<float>(-kG * cosine), 0.0F};
    const auto solver = this->solver();
    Vec3 settled;
    for (int k = 0; k < 480; ++k) {
      step_on_floor(rig, *solver);
      if (k == 239) settled = rig.states[0].x;
    }
    const double way = 0.5 * kG * cosine * (0.5 - static_cast<double>(mu)) * 4.0;
    if (share < 1.0) {
      EXPECT_NEAR(rig.states[0].x.x, way, 0.02 * way);  // order 1: two steps of 480, and rounding
      continue;
    }
    // The box moves by no more than the slop while it settles, and then stays, but for the rounding of a place below 1
    // m.
    EXPECT_LT(std::abs(rig.states[0].x.x), 0x1p-16 * 0.72 * 16.0);
    EXPECT_LT(core::length(rig.states[0].x - settled), 0x1p-20);
  }
}

// The box arrives with the speed sqrt(2 g h) and leaves with the share e of it.
TEST_P(ContactSolvers, BouncesBackWithTheShareOfRestitution) {
  for (const float e : {0.5F, 0.8F, 1.0F}) {
    BoxRig rig;
    rig.dt_s = 1.0F / 480.0F;
    rig.add({0.5F, 0.5F, 0.5F}, {0.0F, 1.5F, 0.0F}, 1.0F, {0.5F, 0.5F, e});
    const auto solver = this->solver();
    double highest = 0.0;
    for (int k = 0; k < 480; ++k) {
      step_on_floor(rig, *solver);
      if (rig.states[0].v.y > 0.0F) highest = std::max(highest, static_cast<double>(rig.states[0].v.y));
    }
    EXPECT_NEAR(highest, static_cast<double>(e) * std::sqrt(2.0 * kG), 2.0 * kG / 480.0) << "e = " << e;
  }
}

// Each of a pillar's patches bounces at most once a step, when it first meets its partner. At rest there are no sweeps
// for bounces.
TEST_P(ContactSolvers, BouncesWhereItIsFirstMet) {
  constexpr std::uint64_t kMostSweeps = 5 * (32 + 8);  // to stop what approached fast, and to give its share back
  BoxRig rig = pillar(5, 1.0F);
  for (core::Material& material : rig.materials) material.restitution = 0.5F;
  rig.face_material.restitution = 0.5F;
  for (core::RigidState& state : rig.states) {
    state.x.y += 0.02F;
    state.v.y = -2.0F;
  }
  const auto solver = this->solver();
  std::uint64_t before = 0;
  const auto sweeps_of_step = [&] {
    step_pillar(rig, *solver);
    const std::uint64_t sweeps = solver->sweeps_done().bouncing - before;
    before += sweeps;
    return sweeps;
  };
  EXPECT_GT(sweeps_of_step(), 0U);
  EXPECT_GT(rig.states[0].v.y, 0.0F);
  for (int k = 1; k < 300; ++k) ASSERT_LE(sweeps_of_step(), k < 240 ? kMostSweeps : 0U) << "step " << k;
}

struct Landing {
  double deepest_m = 0.0;
  std::uint64_t sweeps = 0;
};

// Twelve cubes on top of each other land at 3 m/s and bounce, 40 steps.
Landing column_that_lands(const core::SoftSettings& settings) {
  BoxRig rig = pillar(12, 1.0F);
  for (core::Material& material : rig.materials) material.restitution = 0.3F;
  rig.face_material.restitution = 0.3F;
  for (core::RigidState& state : rig.states) {
    state.x.y += 0.01F;
    state.v.y = -3.0F;
  }
  const auto solver = make_soft_solver(settings);
  Landing landing;
  for (int k = 0; k < 40; ++k) {
    step_pillar(rig, *solver);
    for (const core::ContactPatch& patch : rig.patches)
      for (int point = 0; point < patch.manifold.count; ++point)
        landing.deepest_m = std::max(landing.deepest_m, -static_cast<double>(patch.manifold.points[point].gap_m));
  }
  landing.sweeps = solver->sweeps_done().solving + solver->sweeps_done().bouncing;
  return landing;
}

// The impulse that stops the lowest of many cubes has to reach the uppermost. Sweeps without conjugate directions left
// the cubes 1.3 mm deep in each other. Where pushes are kept, sweeps relax them together with the bounces; that takes
// fewer sweeps than taking pushes back does.
TEST(ConjugateSolver, AColumnThatLandsIsStopped) {
  const Landing landing = column_that_lands({});
  EXPECT_LT(landing.deepest_m, 1e-3);
  core::SoftSettings taken_back;
  taken_back.even = taken_back.even_calm;
  EXPECT_LT(landing.sweeps, column_that_lands(taken_back).sweeps);
}

// Spinning boxes hit the floor with a corner, with much friction and restitution: Newton's rule alone gives some of
// them more energy than they had.
TEST(ConjugateSolver, CornerThatBouncesGainsNoEnergy) {
  for (int kind = 0; kind < 60; ++kind) {
    const auto t = static_cast<float>(kind);
    BoxRig rig;
    rig.gravity_m_s2 = {};
    rig.dt_s = 1.0F / 240.0F;
    rig.add({0.15F, 0.3F, 0.1F}, {0.0F, 0.45F, 0.0F}, 2.0F, {1.0F, 0.9F, 0.8F});
    rig.states[0].q = unit({1.0F, 0.012F * t, 0.3F, 0.4F - 0.015F * t});
    rig.states[0].v = {0.05F * t - 1.5F, -2.0F, 0.8F - 0.03F * t};
    rig.states[0].angular_momentum = {0.02F * t - 0.6F, 0.3F, 0.5F - 0.02F * t};
    const auto energy = [&] {
      const core::RigidState& s = rig.states[0];
      return 0.5F * 2.0F * core::dot(s.v, s.v) +
             0.5F * core::dot(core::angular_velocity(rig.masses[0], s), s.angular_momentum);
    };
    const auto solver = make_contact_solver({});
    float before = energy();
    for (int k = 0; k < 60; ++k) {
      step_on_floor(rig, *solver, 0.1F);
      // Rounding of some hundred additions to velocities.
      EXPECT_LE(energy(), before * (1.0F + 0x1p-16F)) << "kind " << kind << " step " << k;
      before = energy();
    }
  }
}

TEST_P(ContactSolvers, SameBitsOnAnyNumberOfThreads) {
  const auto run = [&](int threads) {
    BoxRig rig;
    for (int k = 0; k < 400; ++k) {
      const auto i =
          rig.add({0.5F, 0.5F, 0.5F}, {static_cast<float>(1.2 * (k / 2)), 0.6F + 1.1F * static_cast<float>(k % 2), 0},
                  1.0F, {0.5F, 0.4F, 0.2F});
      rig.states[i].v = {0.01F * static_cast<float>(k % 7), 0.0F, 0.02F * static_cast<float>(k % 5)};
    }
    const auto solver = this->solver();
    tbb::task_arena arena(threads);
    for (int step = 0; step < 40; ++step) {
      rig.patches.clear();
      for (std::uint32_t k = 0; k < 400; ++k) {
        if (k % 2 == 0)
          rig.meet_floor(k, 0.2F);
        else
          rig.meet_top(k, k - 1, 0.2F);
      }
      arena.execute([&] { rig.step(*solver); });
    }
    return rig.states;
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(3));
}

INSTANTIATE_TEST_SUITE_P(Rigid, ContactSolvers, testing::ValuesIn(kSolverKinds), [](const auto& kind) {
  return kind.param == SolverKind::kSoftStep ? "SoftStep" : "Conjugate";
});

}  // namespace
}  // namespace broadside::reference
