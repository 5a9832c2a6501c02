// How far two bodies can go along the motion of a step before they overlap: RIGID 8.7.
//
// The contacts of a step are those that are detected at its start. Bodies that move farther than they are thick may
// meet others without such a contact. These bodies stop on their way and keep their velocities; the contacts of the
// next step act on them. The method is conservative advancement (Mirtich, 1996): each advance is no longer than the
// distance over the largest speed at which it can shrink.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/rigid_integrate.hpp"

namespace broadside::core {

// A body's way is cut into this many equal parts, and a body stops after a whole number of them. So a body that others
// stop again and again has finitely many places to stop at, and the stage ends.
inline constexpr std::uint32_t kPartsOfWay = 256;

// The most rounds; a pile of bodies that stop each other one after another may need many. Bodies that still meet after
// the last round stay where the step began.
inline constexpr std::uint32_t kMostSweepRounds = 64;

// How deep two bodies may be in each other, as a share of the thinner one's half thickness.
inline constexpr float kSweptDepthShare = 0x1p-4F;

// Bodies that are deeper already may get a little deeper in each step, up to this many times that depth; then they may
// only part. That is less than a twentieth of the thickness, the limit of class B. Before, bodies that were squeezed
// between others passed through each other little by little.
inline constexpr float kHeldDepth = 1.5F;

// The search stops where less than this share of the depth is left.
inline constexpr float kDoneShare = 0x1p-5F;

// After this many advances a way ends at the point up to which it is known to be clear.
inline constexpr int kMostAdvances = 64;

// The motion of one body in a step.
struct SweptWay {
  ContactPose start;
  ContactPose end;
  float swing_m = 0.0F;  // the farthest that turning from start to end moves a point of the shape
};

// The end orientation as q or -q, so that the turn takes the shorter of the two ways.
BROADSIDE_HD constexpr Quat nearer_end(Quat start, Quat end) {
  return dot(start, end) < 0.0F ? -1.0F * end : end;
}

// The farthest that turning moves a point of a body that reaches outer_m from its center, m. The orientation goes along
// the chord and turns fastest in its middle, where the chord of at most a quarter turn of the 4-sphere is 1 / sqrt(2)
// from its center; a turn of q by x turns the body by 2 x.
BROADSIDE_HD float swing_of(ContactPose start, ContactPose end, float outer_m) {
  constexpr float kFastest = 2.8285F;
  const Quat d = nearer_end(start.q, end.q) + -1.0F * start.q;
  return kFastest * sqrtf(dot(d, d)) * outer_m;
}

// No point of the body moves by more than this, m.
BROADSIDE_HD float length_of(const SweptWay& way) {
  return length(way.end.x - way.start.x) + way.swing_m;
}

BROADSIDE_HD SweptWay free_way(const ContactPath& path, float outer_m) {
  return {path.start, path.end, swing_of(path.start, path.end, outer_m)};
}

// q scaled to length 1. The length is computed in double, because normals of contacts are turned by q, and with a
// length in float one normal was off by 4.03 units in the last place.
BROADSIDE_HD Quat of_unit_length(Quat q) {
  const auto square = [](float x) { return static_cast<double>(x) * x; };
  const double scale = 1.0 / sqrt(((square(q.w) + square(q.x)) + square(q.y)) + square(q.z));
  const auto scaled = [scale](float x) { return static_cast<float>(scale * x); };
  return {scaled(q.w), scaled(q.x), scaled(q.y), scaled(q.z)};
}

// The pose after a share of the way, 0 to 1.
BROADSIDE_HD ContactPose pose_at(const SweptWay& way, float share) {
  const Quat end = nearer_end(way.start.q, way.end.q);
  return {way.start.x + share * (way.end.x - way.start.x), of_unit_length((1.0F - share) * way.start.q + share * end)};
}

struct NearestPatch {
  float gap_m = 0.0F;
  Vec3 normal;  // from b to a
  bool is_found = false;
};

template <typename Lanes = OneLane>
BROADSIDE_HD_CALLED NearestPatch nearest_patch(const ContactShape& a, ContactPose at_a, const ContactShape& b,
                                               ContactPose at_b, float reach_m) {
  Manifold found[kPatchesOfPair];
  const int count = make_manifolds<Lanes>(a, at_a, b, at_b, reach_m, found);
  NearestPatch nearest;
  for (int k = 0; k < count; ++k) {
    const float gap = least_gap_m(found[k]);
    if (nearest.is_found && !(gap < nearest.gap_m)) continue;
    nearest = {gap, found[k].normal, true};
  }
  return nearest;
}

// Whether bodies that overlap at the start overlap no more at the end, and on the same side.
template <typename Lanes>
BROADSIDE_HD bool part_at_end(const NearestPatch& start, const ContactShape& a, const SweptWay& way_a,
                              const ContactShape& b, const SweptWay& way_b, float reach_m) {
  const NearestPatch end = nearest_patch<Lanes>(a, way_a.end, b, way_b.end, reach_m);
  return !end.is_found || (end.gap_m >= start.gap_m && dot(end.normal, start.normal) > 0.0F);
}

// The share of both ways, gone at the same time, up to which the bodies overlap by no more than allowed_m. Bodies that
// overlap by more at the start, up to kHeldDepth times allowed_m, may overlap by 2 done_m more than at the start. Still
// deeper ones go all of their way if they part, and none of it otherwise. The search stops where less than done_m is
// left. For two convex shapes it follows the direction that parts them, or in which they overlap least, because only
// along it can they come nearer.
template <typename Lanes = OneLane>
BROADSIDE_HD_CALLED float clear_share(const ContactShape& a, const SweptWay& way_a, const ContactShape& b,
                                      const SweptWay& way_b, float allowed_m, float done_m) {
  const Vec3 toward = (way_b.end.x - way_b.start.x) - (way_a.end.x - way_a.start.x);
  const float swing = way_a.swing_m + way_b.swing_m;
  const bool is_mesh = a.kind == ContactKind::kMesh || b.kind == ContactKind::kMesh;
  const float most = length(toward) + swing;
  float allowed = allowed_m;
  float share = 0.0F;
  for (int k = 0; k < kMostAdvances; ++k) {
    const NearestPatch near =
        nearest_patch<Lanes>(a, pose_at(way_a, share), b, pose_at(way_b, share), (1.0F - share) * most + done_m);
    if (!near.is_found) return 1.0F;
    if (k == 0 && 2.0F * done_m - near.gap_m > allowed_m) {
      if (-near.gap_m > kHeldDepth * allowed_m)
        return part_at_end<Lanes>(near, a, way_a, b, way_b, most + done_m) ? 1.0F : 0.0F;
      allowed = 2.0F * done_m - near.gap_m;
    }
    const float clear = near.gap_m + allowed;
    if (!(clear > done_m)) return share;
    const float closing = is_mesh ? most : fmaxf(dot(near.normal, toward), 0.0F) + swing;
    if (!((1.0F - share) * closing > clear)) return 1.0F;
    share = share + clear / closing;
  }
  return share;
}

// How deep two bodies may be in each other, and how near to that the search stops, m. thinner_m: half of the least
// thickness of the thinner one.
BROADSIDE_HD constexpr float swept_depth_m(float thinner_m) {
  return kSweptDepthShare * thinner_m;
}
BROADSIDE_HD constexpr float swept_done_m(float thinner_m) {
  return kDoneShare * swept_depth_m(thinner_m);
}

// Whether two bodies do not touch on their free ways, whether both move or something holds one of them.
template <typename Lanes = OneLane>
BROADSIDE_HD bool misses(const ContactShape& a, const SweptWay& way_a, const ContactShape& b, const SweptWay& way_b,
                         float thinner_m) {
  const SweptWay held_a{way_a.start, way_a.start, 0.0F};
  const SweptWay held_b{way_b.start, way_b.start, 0.0F};
  const float done_m = swept_done_m(thinner_m);
  return clear_share<Lanes>(a, way_a, b, way_b, 0.0F, done_m) == 1.0F &&
         clear_share<Lanes>(a, way_a, b, held_b, 0.0F, done_m) == 1.0F &&
         clear_share<Lanes>(a, held_a, b, way_b, 0.0F, done_m) == 1.0F;
}

// Whether bodies move so far that they may pass through each other.
BROADSIDE_HD bool moves_far(float way_a_m, float way_b_m, float thinner_m) {
  return way_a_m + way_b_m > swept_depth_m(thinner_m);
}

// Whether a patch of two bodies that move far leads to no contact in the step. Such a patch is dropped, because the
// planes of patches that are far away mislead the solver. If a push changes the way, the sweep after the response takes
// care of it. fall_m: how far both bodies fall.
template <typename Lanes = OneLane>
BROADSIDE_HD_CALLED bool misses_patch(const Manifold& found, const ContactShape& a, const SweptWay& way_a,
                                      const ContactShape& b, const SweptWay& way_b, float fall_m, float thinner_m) {
  return least_gap_m(found) > fall_m + thinner_m && misses<Lanes>(a, way_a, b, way_b, thinner_m);
}

// The first `parts` of the way's kPartsOfWay parts.
BROADSIDE_HD SweptWay part_of_way(SweptWay way, std::uint32_t parts) {
  if (parts == kPartsOfWay) return way;
  const float share = static_cast<float>(parts) / static_cast<float>(kPartsOfWay);
  way.end = pose_at(way, share);
  way.swing_m = share * way.swing_m;
  return way;
}

// A box that contains the body on all of its way: a point of the body stays within swing_m of the line between its two
// ends.
BROADSIDE_HD Box box_of_way(const Box& start, const Box& end, float swing_m) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = fminf(start.min[axis], end.min[axis]) - swing_m;
    box.max[axis] = fmaxf(start.max[axis], end.max[axis]) + swing_m;
  }
  return box;
}

}  // namespace broadside::core
