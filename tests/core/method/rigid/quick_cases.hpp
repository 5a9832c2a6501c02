// Quick answers about pairs that may pass by each other, compared with those that patches give.
#pragma once

#include <gtest/gtest.h>

#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/quick_hulls.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {

// The same answer as is_still_apart, from patches alone.
inline bool stays_apart(const Manifold& start, const Subject& a, const ContactPose& at_a, const Subject& b,
                        const ContactPose& at_b, float reach_m) {
  Manifold end[kPatchesOfPair];
  if (make_manifolds(a.shape, at_a, b.shape, at_b, reach_m, end) == 0) return false;
  return least_gap_m(end[0]) > 0.0F && dot(start.normal, end[0].normal) > 0.0F;
}

struct QuickCounts {
  int passing = 0;
  int told = 0;         // of these, by bounds
  int answers[3] = {};  // by QuickAnswer
};

// Two bodies that come near each other within a step. body_a(trial), body_b(trial): the bodies, of about a meter.
// bounds_of(a, pose, b, pose, seen_m): bounds of their distance there.
template <typename BodyA, typename BodyB, typename BoundsOf>
QuickCounts compare_quick_answers(Draw& draw, int trials, const BodyA& body_a, const BodyB& body_b,
                                  const BoundsOf& bounds_of) {
  QuickCounts counts;
  for (int trial = 0; trial < trials; ++trial) {
    const Subject a = body_a(trial);
    const Subject b = body_b(trial);
    ContactPath path_a{{{}, draw.turn()}, {}};
    ContactPath path_b{{draw.between(0.7F, 1.2F) * normalized(draw.in_cube(1.0F)), draw.turn()}, {}};
    path_a.end = {draw.in_cube(0.1F), path_a.start.q};
    path_b.end = {path_b.start.x + draw.in_cube(0.1F), path_b.start.q};
    const float reach_m = length(path_a.end.x - path_a.start.x) + length(path_b.end.x - path_b.start.x);
    const float near_m = 0.01F * static_cast<float>(draw.below(4));
    const PairAhead ahead{.reach_m = reach_m, .near = {near_m, {}, {}}, .swing_m = 0.0F};
    KnownGaps gaps;
    const bool surely = surely_passes(a.shape, path_a, b.shape, path_b, ahead, gaps);
    counts.told += surely ? 1 : 0;
    Manifold start[kPatchesOfPair];
    const int count = make_manifolds(a.shape, path_a.start, b.shape, path_b.start, reach_m, start);
    bool passes = count == 0;
    if (count > 0) {
      const ContactPose* const ends[3][2] = {
          {&path_a.end, &path_b.end}, {&path_a.end, &path_b.start}, {&path_a.start, &path_b.end}};
      passes = least_gap_m(start[0]) > near_m;
      for (const auto& [at_a, at_b] : ends) {
        const bool apart = stays_apart(start[0], a, *at_a, b, *at_b, 2.0F * reach_m);
        passes &= apart;
        const float seen_m = seen_reach_m(reach_m);
        const QuickAnswer answer = quickly_still_apart(start[0].normal, bounds_of(a, *at_a, b, *at_b, seen_m), seen_m);
        ++counts.answers[static_cast<int>(answer)];
        if (answer != QuickAnswer::kUnknown) {
          EXPECT_EQ(answer == QuickAnswer::kYes, apart) << trial;
        }
      }
    }
    counts.passing += passes ? 1 : 0;
    if (surely) {
      EXPECT_TRUE(passes) << trial;
    }
  }
  return counts;
}

// Most pairs get a quick answer; otherwise it would save nothing.
inline void expect_most_are_quick(const QuickCounts& counts) {
  EXPECT_GT(counts.told, counts.passing * 2 / 3);
  EXPECT_GT(counts.answers[static_cast<int>(QuickAnswer::kYes)], 50);
  EXPECT_GT(counts.answers[static_cast<int>(QuickAnswer::kNo)], 50);
  EXPECT_LT(counts.answers[static_cast<int>(QuickAnswer::kUnknown)], 100);
}

}  // namespace broadside::core
