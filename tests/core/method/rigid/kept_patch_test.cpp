// A patch that is carried along with its bodies equals the patch that they would get anew, to within the allowed error.
#include "core/method/rigid/kept_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

constexpr float kOuter = 0.6F;
constexpr float kFalls = 2.0F * 9.81F / 3600.0F;  // of two bodies, in a step of 1/60 s

Quat product(Quat a, Quat b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quat turn_by(Vec3 axis, float angle) {
  const float s = std::sin(0.5F * angle);
  return {std::cos(0.5F * angle), s * axis.x, s * axis.y, s * axis.z};
}

struct Touching {
  Subject a;
  Subject b;
  Manifold manifold;
};

// Pairs of round hulls that touch, turned at random.
class Hulls {
 public:
  explicit Hulls(std::uint64_t seed) : draw(seed) {
    for (int k = 0; k < 4; ++k) hulls_.push_back(cut_ellipsoid(draw, {0.5F, 0.45F, 0.4F}, 60));
  }
  Touching touching() {
    for (;;) {
      Touching t{hulls_[static_cast<std::size_t>(draw.below(4))], hulls_[static_cast<std::size_t>(draw.below(4))], {}};
      t.a.pose = {draw.in_cube(20.0F), draw.turn()};
      t.b.pose = {t.a.pose.x + 0.95F * normalized(draw.in_cube(1.0F)), draw.turn()};
      // The nearest point changes as the body moves, so the body is brought nearer a few times.
      Manifold found[kPatchesOfPair];
      int count = 0;
      for (int nearer = 0; nearer < 6; ++nearer) {
        count = make_manifolds(t.a.shape, t.a.pose, t.b.shape, t.b.pose, 1.0F, found);
        if (count != 1) break;
        t.b.pose.x = t.b.pose.x + least_gap_m(found[0]) * found[0].normal;
      }
      if (count == 1) count = make_manifolds(t.a.shape, t.a.pose, t.b.shape, t.b.pose, 0.01F, found);
      if (count != 1 || std::abs(least_gap_m(found[0])) > 1e-4F) continue;
      t.manifold = found[0];
      return t;
    }
  }
  Draw draw;

 private:
  std::vector<Subject> hulls_;
};

void expect_same(const Manifold& m, const Manifold& n, float within_m) {
  ASSERT_EQ(m.count, n.count);
  EXPECT_LT(length(m.normal - n.normal), 1e-5F);
  for (int k = 0; k < m.count; ++k) {
    EXPECT_LT(length(m.points[k].point - n.points[k].point), within_m);
    EXPECT_NEAR(m.points[k].gap_m, n.points[k].gap_m, within_m);
    EXPECT_EQ(m.points[k].feature, n.points[k].feature);
  }
}

TEST(KeptPatch, IsItselfWhereItWasMade) {
  Hulls hulls(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Touching t = hulls.touching();
    Manifold carried;
    carry(kept_patch(t.manifold, t.a.pose, t.b.pose), t.a.pose, t.b.pose, carried);
    expect_same(carried, t.manifold, 4e-6F);
    EXPECT_NEAR(length(carried.normal), 1.0F, 0x1p-22F);
  }
}

TEST(KeptPatch, GoesAlongWithBodiesThatMoveTogether) {
  Hulls hulls(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Touching t = hulls.touching();
    const KeptPatch kept = kept_patch(t.manifold, t.a.pose, t.b.pose);
    const Quat turn = hulls.draw.turn();
    const Vec3 shift = hulls.draw.in_cube(5.0F);
    const auto moved = [&](const ContactPose& p) { return ContactPose{shift + rotate(turn, p.x), product(turn, p.q)}; };
    const ContactPose a = moved(t.a.pose);
    const ContactPose b = moved(t.b.pose);
    EXPECT_LT(moved_between(kept.made_at, pose_of_other(a, b), kOuter), 2e-5F);
    Manifold carried;
    carry(kept, a, b, carried);
    Manifold turned = t.manifold;
    turned.normal = rotate(turn, turned.normal);
    for (int k = 0; k < turned.count; ++k) turned.points[k].point = rotate(turn, turned.points[k].point);
    expect_same(carried, turned, 2e-5F);
  }
}

TEST(KeptPatch, KnowsHowFarPointsHaveMoved) {
  Draw draw(3);
  float tightest = 0.0F;
  for (int trial = 0; trial < 2000; ++trial) {
    const ContactPose a{draw.in_cube(3.0F), draw.turn()};
    const ContactPose b{draw.in_cube(3.0F), draw.turn()};
    const float size = draw.between(0.001F, 0.5F);
    const ContactPose later_a{a.x + draw.in_cube(size),
                              product(turn_by(normalized(draw.in_cube(1.0F)), draw.between(0.0F, size)), a.q)};
    const ContactPose later_b{b.x + draw.in_cube(size),
                              product(turn_by(normalized(draw.in_cube(1.0F)), draw.between(0.0F, size)), b.q)};
    const float bound = moved_between(pose_of_other(a, b), pose_of_other(later_a, later_b), kOuter);
    const Vec3 arm = kOuter * normalized(draw.in_cube(1.0F));
    const auto seen_from_a = [&](const ContactPose& pa, const ContactPose& pb) {
      return turned_back(turned_axes(pa.q), (pb.x - pa.x) + rotate(pb.q, arm));
    };
    const float moved = length(seen_from_a(later_a, later_b) - seen_from_a(a, b));
    EXPECT_LE(moved, bound + 4e-6F);
    tightest = std::max(tightest, moved / bound);
  }
  EXPECT_GT(tightest, 0.9F);
}

// For bodies that move by less than the limit for carrying a patch, its least gap is their distance to within that
// limit.
TEST(KeptPatch, IsOffByNoMoreThanItMayBe) {
  Hulls hulls(4);
  int carried_count = 0;
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Touching t = hulls.touching();
    const KeptPatch kept = kept_patch(t.manifold, t.a.pose, t.b.pose);
    const float within_m = kept_within_m(t.a.shape, t.b.shape, kFalls);
    ASSERT_GT(within_m, 1e-4F);
    Subject b = t.b;
    b.pose.x = b.pose.x + hulls.draw.between(0.0F, 1.5F) * within_m * normalized(hulls.draw.in_cube(1.0F));
    Manifold carried_to;
    const bool is_carried = carried(kept, t.a.shape, t.a.pose, b.shape, b.pose, kOuter, kFalls, carried_to);
    if (!is_carried) {
      ++refused;
      EXPECT_GT(length(b.pose.x - t.b.pose.x), 0.99F * within_m);
      continue;
    }
    ++carried_count;
    const double truth = exact::signed_distance(t.a.placed(), b.placed()).distance_m;
    EXPECT_NEAR(least_gap_m(carried_to), truth, within_m + 1e-5);
  }
  EXPECT_GT(carried_count, 100);
  EXPECT_GT(refused, 50);
}

TEST(KeptPatch, IsMadeAnewWhereBodiesAreFastOrFollowedOrWithoutGravity) {
  Hulls hulls(5);
  const Touching t = hulls.touching();
  PairAhead ahead;
  ahead.near.falls_m = kFalls;
  ahead.reach_m = 1.2F * kFalls;
  ASSERT_TRUE(may_be_carried(t.a.shape, t.b.shape, ahead));
  PairAhead faster = ahead;
  faster.reach_m = 2.0F * kFalls;
  EXPECT_FALSE(may_be_carried(t.a.shape, t.b.shape, faster));
  PairAhead followed = ahead;
  followed.may_pass = false;
  EXPECT_FALSE(may_be_carried(t.a.shape, t.b.shape, followed));
  PairAhead spinning = ahead;
  spinning.swing_m = 2.0F * unseen_m(t.a.shape, t.b.shape);
  EXPECT_FALSE(may_be_carried(t.a.shape, t.b.shape, spinning));
  EXPECT_FALSE(may_be_carried(box({0.5F, 0.5F, 0.5F}).shape, t.b.shape, ahead));

  Manifold out;
  const KeptPatch kept = kept_patch(t.manifold, t.a.pose, t.b.pose);
  EXPECT_TRUE(carried(kept, t.a.shape, t.a.pose, t.b.shape, t.b.pose, kOuter, kFalls, out));
  EXPECT_FALSE(carried(kept, t.a.shape, t.a.pose, t.b.shape, t.b.pose, kOuter, 0.0F, out)) << "no gravity";
  EXPECT_FALSE(carried({}, t.a.shape, t.a.pose, t.b.shape, t.b.pose, kOuter, kFalls, out)) << "nothing was kept";
}

}  // namespace
}  // namespace broadside::core
