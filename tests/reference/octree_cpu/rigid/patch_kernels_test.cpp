// Patches solved side by side give the bits of patches solved one by one, with every instruction set that the machine
// has.
#include "reference/octree_cpu/rigid/patch_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/pushed_apart.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::reference {
namespace {

using core::PatchConstraint;
using core::SolverBody;

constexpr std::uint32_t kStill = 2 * kTileLanes;  // the last of the bodies stands still

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  core::Vec3 vector(float size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  bool one_of(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }

 private:
  std::mt19937 engine_;
};

// Two bodies for each lane, some of which never move or have turned far, and one that stands still.
std::vector<SolverBody> some_bodies(Random& random) {
  std::vector<SolverBody> bodies(kStill + 1);
  for (std::uint32_t k = 0; k < kStill; ++k) {
    if (k % 2 == 1 && random.one_of(4)) continue;
    SolverBody& body = bodies[k];
    body.inverse_mass = random.in(0.1F, 2.0F);
    body.inverse_inertia = {random.in(1.0F, 3.0F), random.in(1.0F, 3.0F), random.in(1.0F, 3.0F),
                            random.in(0.0F, 0.2F), random.in(0.0F, 0.2F), random.in(0.0F, 0.2F)};
    body.v = random.vector(2.0F);
    if (random.one_of(3)) body.v.x = -0.0F;
    body.angular_momentum = random.vector(0.5F);
    body.moved = random.vector(0.01F);
    body.turned = random.vector(random.one_of(3) ? 0.5F : 0.0005F);
  }
  return bodies;
}

PatchConstraint some_patch(Random& random, std::uint32_t lane, int count, const std::vector<SolverBody>& bodies) {
  core::Manifold manifold;
  manifold.normal = core::normalized(random.vector(1.0F) + core::Vec3{0.0F, 2.0F, 0.0F});
  manifold.count = count;
  for (int k = 0; k < count; ++k) manifold.points[k] = {random.vector(0.5F), random.in(-0.02F, 0.02F), 1};
  const core::Material surface{0.6F, 0.5F, random.one_of(2) ? 0.3F : 0.0F};
  PatchConstraint c =
      core::make_constraint(manifold, bodies[2 * lane], bodies[2 * lane + 1], {0.0F, 1.0F, 0.0F}, surface);
  c.a = 2 * lane;
  c.b = 2 * lane + 1;
  c.slop_m = random.in(0.0F, 0.001F);
  c.fastest_push_m_s = random.in(0.0F, 1.0F);
  for (int k = 0; k < count; ++k) {
    c.points[k].normal_impulse = random.one_of(3) ? 0.0F : random.in(0.0F, 1.0F);
    c.points[k].tangent_impulse_1 = random.in(-0.3F, 0.3F);
    c.points[k].tangent_impulse_2 = random.in(-0.3F, 0.3F);
    c.points[k].normal_total = random.one_of(2) ? 0.0F : random.in(0.0F, 1.0F);
    c.points[k].approach_m_s = random.in(-1.0F, 2.0F);
  }
  return c;
}

core::SoftStep some_step(float gravity_m_s2) {
  core::SoftStep step = core::soft_step(1.0F / 240.0F, 6.0F, 1.0F);
  step.settle_m_s = 0.002F;
  step.bounce_from_m_s = 0.5F;
  step.gravity_m_s2 = gravity_m_s2;
  return step;
}

void expect_same_bits(float found, float expected, const char* what, int point) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(expected))
      << what << " of point " << point << ": " << found << " instead of " << expected;
}

void expect_same(const PatchConstraint& found, const PatchConstraint& expected) {
  ASSERT_EQ(found.count, expected.count);
  for (int k = 0; k < found.count; ++k) {
    const core::PatchPoint& p = found.points[k];
    const core::PatchPoint& q = expected.points[k];
    expect_same_bits(p.normal_mass, q.normal_mass, "normal mass", k);
    expect_same_bits(p.stick_mass_12, q.stick_mass_12, "stick mass", k);
    expect_same_bits(p.slip_mobility, q.slip_mobility, "slip mobility", k);
    expect_same_bits(p.normal_impulse, q.normal_impulse, "normal impulse", k);
    expect_same_bits(p.tangent_impulse_1, q.tangent_impulse_1, "tangent impulse 1", k);
    expect_same_bits(p.tangent_impulse_2, q.tangent_impulse_2, "tangent impulse 2", k);
    expect_same_bits(p.normal_total, q.normal_total, "normal total", k);
    expect_same_bits(p.tangent_total_1, q.tangent_total_1, "tangent total 1", k);
    expect_same_bits(p.approach_m_s, q.approach_m_s, "approach", k);
    EXPECT_EQ(p.slides, q.slides) << "point " << k;
  }
}

// A substep of patches one by one, as soft_contact.hpp has it.
struct OneByOne {
  std::vector<SolverBody> bodies;
  std::vector<PatchConstraint> patches;
  std::vector<core::PatchWay> ways;
  std::vector<float> speeds;   // of the fastest point at first, then of each sweep
  std::vector<float> changes;  // of the last sweep
  std::vector<float> pushes;
  std::vector<float> relaxed;  // what relaxation changed

  template <typename Work>
  void each(const Work& work) {
    for (std::size_t k = 0; k < patches.size(); ++k) work(patches[k], bodies[patches[k].a], bodies[patches[k].b], k);
  }

  void relax(const core::SoftStep& step) {
    relaxed.assign(patches.size(), 0.0F);
    each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t k) {
      relaxed[k] = core::relax_patch(c, core::goals_after_motion(c, a, b, step), a, b);
    });
  }

  // Relaxes all patches, then sweeps over those of stirred bodies, each sweep with its share of the last direction.
  // Returns how many patches the last sweep left alone.
  std::size_t stir(const core::SoftStep& step, std::span<const float> shares, float done_m_s,
                   std::vector<std::uint32_t>& stirred) {
    ways.assign(patches.size(), {});
    std::vector<std::uint8_t> follows(patches.size(), 0);
    std::size_t left_alone = 0;
    relax(step);
    for (std::uint32_t n = 0; n < shares.size(); ++n) {
      speeds.push_back(0.0F);
      changes.assign(patches.size(), 0.0F);
      left_alone = 0;
      each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t k) {
        if (shares[n] > 0.0F && follows[k] != 0) core::push_along(c, ways[k], a, b, shares[n]);
      });
      each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t k) {
        if (follows[k] == 0 && stirred[c.a] < n + 1 && stirred[c.b] < n + 1) {
          ++left_alone;
          return;
        }
        if (follows[k] != 0) core::follow_impulses(c, ways[k], shares[n]);
        core::note_impulses(c, ways[k]);
        const float change = core::relax_patch(c, core::goals_after_motion(c, a, b, step), a, b);
        if (core::has_directions(step)) changes[k] = core::squared_change(c, ways[k]);
        follows[k] = core::has_directions(step) ? 1 : 0;
        speeds.back() = std::max(speeds.back(), change);
        if (!(change > done_m_s)) return;
        for (const std::uint32_t body : {c.a, c.b})
          if (core::is_moved(bodies[body])) stirred[body] = n + 2;
      });
    }
    return left_alone;
  }

  void run(const core::SoftStep& step, std::span<const float> shares) {
    ways.assign(patches.size(), {});
    changes.assign(patches.size(), 0.0F);
    float fastest = 0.0F;
    each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t) {
      fastest = std::max(fastest, core::fastest_point(c, core::motion_of<float>(c, a, b)));
    });
    speeds.push_back(fastest);
    each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t) {
      core::forget_slips(c);
      pushes.push_back(core::fastest_push(c, step, core::gaps_now(c, a, b)));
    });
    each([](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t) { core::warm_start(c, a, b); });
    for (std::size_t n = 0; n <= shares.size(); ++n) {
      float largest = 0.0F;
      each([&](PatchConstraint& c, SolverBody& a, SolverBody& b, std::size_t k) {
        core::note_impulses(c, ways[k]);
        largest = std::max(largest, core::solve_patch(c, core::goals_of(c, a, b, step), a, b, step));
        changes[k] = core::squared_change(c, ways[k]);
        if (n == shares.size()) return;  // a sweep comes last
        core::push_along(c, ways[k], a, b, shares[n]);
        core::follow_impulses(c, ways[k], shares[n]);
      });
      speeds.push_back(largest);
    }
    relax(step);
    each([&](PatchConstraint& c, SolverBody&, SolverBody&, std::size_t) {
      core::drop_impacts(c);
      core::add_to_totals(c);
    });
  }
};

// The tile of these patches, made by these kernels.
class OneTile {
 public:
  OneTile(const PatchKernels& kernels, const OneByOne& one)
      : bodies(one.bodies), memory_(kernels.tile_bytes / sizeof(std::max_align_t) + 8) {
    kernels.clear(tiles(), 0, kStill);
    for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane) kernels.put(tiles(), 0, lane, one.patches[lane]);
  }
  [[nodiscard]] std::byte* tiles() {
    return reinterpret_cast<std::byte*>((reinterpret_cast<std::uintptr_t>(memory_.data()) + 63) / 64 * 64);
  }
  [[nodiscard]] TileRange range() { return {tiles(), 0, 1, bodies.data()}; }

  std::vector<SolverBody> bodies;

 private:
  std::vector<std::max_align_t> memory_;
};

// The last lane has no patch.
OneByOne some_patches(Random& random, int points) {
  OneByOne one{some_bodies(random), {}, {}, {}, {}, {}, {}};
  for (std::uint32_t lane = 0; lane + 1 < kTileLanes; ++lane)
    one.patches.push_back(some_patch(random, lane, points, one.bodies));
  return one;
}

void expect_same_substep(const PatchKernels& kernels, unsigned seed, int points, float gravity_m_s2) {
  SCOPED_TRACE(testing::Message() << kernels.name << ", seed " << seed << ", points " << points);
  Random random(seed);
  const core::SoftStep step = some_step(gravity_m_s2);
  OneByOne one = some_patches(random, points);
  OneTile tile(kernels, one);
  std::byte* const tiles = tile.tiles();
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane)
    expect_same(kernels.get(tiles, 0, lane), one.patches[lane]);

  constexpr std::array kShares{0.0F, 0.7F, 0.3F};
  one.run(step, kShares);

  const TileRange range = tile.range();
  float speed = 0.0F;
  std::array<float, kTileLanes> changes{};
  std::array<float, kTileLanes> pushes{};
  kernels.begin_sweeps(range, step, &speed, pushes.data());
  expect_same_bits(speed, one.speeds[0], "fastest point", 0);
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane)
    expect_same_bits(pushes[lane], one.pushes[lane], "push", static_cast<int>(lane));
  kernels.warm_start(range);
  SweepWay way{true, true, 0.0F, &speed, changes.data()};
  for (std::size_t n = 0; n <= kShares.size(); ++n) {
    kernels.sweep(range, step, way);
    expect_same_bits(speed, one.speeds[n + 1], "change of speed", static_cast<int>(n));
    if (n == kShares.size()) break;
    way.is_first = false;
    way.share = kShares[n];
    kernels.push_along(range, way.share);
  }
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane)
    expect_same_bits(changes[lane], one.changes[lane], "squared change", static_cast<int>(lane));
  std::array<float, kTileLanes> relaxed{};
  kernels.relax(range, step, relaxed.data());
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane)
    expect_same_bits(relaxed[lane], one.relaxed[lane], "relaxed", static_cast<int>(lane));
  kernels.end_substep(range);
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane)
    expect_same(kernels.get(tiles, 0, lane), one.patches[lane]);
  EXPECT_EQ(std::memcmp(tile.bodies.data(), one.bodies.data(), tile.bodies.size() * sizeof(SolverBody)), 0);
}

// Returns how many patches the last sweep left alone.
std::size_t expect_same_stirred(const PatchKernels& kernels, unsigned seed, bool has_directions) {
  SCOPED_TRACE(testing::Message() << kernels.name << ", seed " << seed << (has_directions ? ", directions" : ""));
  Random random(seed);
  core::SoftStep step = some_step(9.81F);
  step.most_sweeps = has_directions ? 12 : 1;
  OneByOne one = some_patches(random, 1 + static_cast<int>(seed % 4));
  OneTile tile(kernels, one);

  constexpr float kDone_m_s = 0.02F;
  std::vector<float> shares{0.0F, 0.0F, 0.0F, 0.0F};
  if (has_directions) shares = {0.0F, 0.7F, 0.0F, 0.3F};
  std::vector<std::uint32_t> stirred(one.bodies.size(), 0);
  for (std::uint32_t k = 0; k < kStill; ++k)
    if (core::is_moved(one.bodies[k]) && random.one_of(4)) stirred[k] = 1;
  std::vector<std::uint32_t> of_tile = stirred;
  const std::size_t left_alone = one.stir(step, shares, kDone_m_s, stirred);

  float largest = -1.0F;
  std::uint8_t followers = 0;
  std::array<float, kTileLanes> changes{};
  std::array<float, kTileLanes> relaxed{};
  kernels.relax(tile.range(), step, relaxed.data());
  StirredSweep sweep{1, kDone_m_s, 0.0F, of_tile.data(), &followers, &largest, changes.data()};
  for (std::size_t n = 0; n < shares.size(); ++n) {
    sweep.share = shares[n];
    if (sweep.share > 0.0F) kernels.push_stirred(tile.range(), sweep);
    kernels.relax_stirred(tile.range(), step, sweep);
    ++sweep.number;
    expect_same_bits(largest, one.speeds[n], "change of speed", static_cast<int>(n));
  }
  for (std::uint32_t lane = 0; lane < one.patches.size(); ++lane) {
    expect_same_bits(changes[lane], one.changes[lane], "squared change", static_cast<int>(lane));
    expect_same(kernels.get(tile.tiles(), 0, lane), one.patches[lane]);
  }
  EXPECT_EQ(of_tile, stirred);
  EXPECT_EQ(std::memcmp(tile.bodies.data(), one.bodies.data(), tile.bodies.size() * sizeof(SolverBody)), 0);
  return left_alone;
}

TEST(PatchKernels, LanesOfStirredBodiesHaveTheBitsOfOnePatch) {
  for (const PatchKernels* kernels : all_patch_kernels()) {
    std::size_t left_alone = 0;
    std::size_t visited = 0;
    for (unsigned seed = 1; seed <= 40; ++seed)
      for (const bool has_directions : {false, true}) {
        const std::size_t alone = expect_same_stirred(*kernels, seed, has_directions);
        left_alone += alone;
        visited += kTileLanes - 1 - alone;
      }
    EXPECT_GT(left_alone, 50U);
    EXPECT_GT(visited, 50U);
  }
}

TEST(PatchKernels, LanesHaveTheBitsOfOnePatch) {
  for (const PatchKernels* kernels : all_patch_kernels())
    for (unsigned seed = 1; seed <= 40; ++seed)
      expect_same_substep(*kernels, seed, 1 + static_cast<int>(seed % 4), seed % 3 == 0 ? 0.0F : 9.81F);
}

}  // namespace
}  // namespace broadside::reference
