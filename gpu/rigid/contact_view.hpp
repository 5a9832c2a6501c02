// The argument, by value, of the kernels that find the contacts of a frame of turning bodies. It is RigidFrameView
// without the data of the solver, so a change of the solver does not compile the code of the shapes again, which takes
// minutes.
#pragma once

#include <cstdint>

#include "core/contact.hpp"
#include "core/engine/stage.hpp"
#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/pushed_motion.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "core/pair.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::core {
struct KeptPatch;
struct KnownGaps;
}  // namespace broadside::core

namespace broadside::gpu {

// A mesh and a center of mass in it; the pointers are to device memory.
struct RigidShapeView {
  core::ContactShape contact;
  const core::NodeBoxes* nodes = nullptr;
  core::VertexTreeView vertices;
  core::ShapeBalls balls;
  float half_thickness_m = 0.0F;  // as core::RigidShape has it
};

// A patch in the list of one of its moved bodies.
struct alignas(8) PatchEntry {
  std::uint32_t patch = 0;
  std::uint32_t other = 0;  // the other body, or a face
};

// For each moved body the list of its patches, in no order, and for each patch the impulses that the last substep left:
// the next step begins with them (warm start). There are two memories: one of the step before, one of this step.
struct PatchMemory {
  std::uint32_t* begin = nullptr;    // [bodies]
  std::uint32_t* count = nullptr;    // [bodies]; 0 of bodies that never move
  std::uint32_t* filled = nullptr;   // [bodies] entries written so far
  PatchEntry* entries = nullptr;     // [2 * patches]
  std::uint32_t* feature = nullptr;  // [4 * patches]; 0 = no point
  PackedVec3* impulse = nullptr;     // [4 * patches] N: friction on A, and w = along the normal
  core::KeptPatch* kept = nullptr;   // [patches]; null where no shape is a hull
};

// The part of core::Pusher that changes from step to step: what a pair reads of one body to find how far that body may
// push the other.
struct alignas(16) PackedPusher {
  PackedVec3 drift;   // w: swing_m, what turning adds
  PackedVec3 pushed;  // w: index of the body that drives it, as bits
};

// What solving a frame's contacts took.
struct SolveCounts {
  std::uint32_t sweeps = 0;         // over all contacts before the bodies move, and over what pushes left
  std::uint32_t bounce_sweeps = 0;  // while contacts bounce
  std::uint32_t waits = 0;          // of all threads for each other
};

// Counts of one frame. Each says how much was needed, even where there was less room. The last kernel of a frame leaves
// zeros.
struct RigidCounts {
  unsigned long long confirmed = 0;
  // Confirmed pairs whose patches are not carried along with their bodies: in ContactView::fresh.
  unsigned long long fresh = 0;
  // Confirmed pairs that may touch: those in ContactView::near, then the two kinds of pairs in ContactView::hulls.
  unsigned long long near = 0;
  unsigned long long near_hulls = 0;
  unsigned long long apart_hulls = 0;  // pairs of hulls that are clearly apart
  unsigned long long patches = 0;
  unsigned long long listed = 0;  // places given out in the lists of bodies
  unsigned long long places = 0;  // of constraints: patches, and the gaps between colors
  // Bits of nonnegative floats, which are ordered like the floats. Infinities and NaN are above all finite numbers.
  std::uint32_t largest_side = 0;
  std::uint32_t largest_coordinate = 0;
  std::uint32_t colors = 0;
  std::uint32_t bounces = 0;      // 1: a patch has restitution
  std::uint32_t fastest_m_s = 0;  // core::Pace of the step, or of its part, as words
  std::uint32_t stride = 0;
  std::uint32_t mass_ratio = 0;  // the largest of two bodies that touch, as a word
  std::uint32_t is_aborted = 0;
  // Numbers to which all threads contribute, in turns (team_sums.cuh).
  std::uint32_t largest[4][4] = {};
  unsigned long long sums[4] = {};
  SolveCounts done;
  // For scenes in which bodies sleep. Patches of sleeping bodies lie behind the others and are not solved.
  unsigned long long asleep_patches = 0;
  unsigned long long asleep_bodies = 0;
  std::uint32_t woken = 0;  // 1: an island wakes, so the frame is repeated
  // Copies of the counts that the host was told, for the launch after the solver, which finds those above cleared.
  std::uint32_t told_is_aborted = 0;
  unsigned long long told_patches = 0;
};

// What the host reads after a frame, in host memory that the device writes.
struct RigidOutcome {
  RigidCounts counts;
  unsigned long long begin_ns = 0;
  unsigned long long stage_end_ns[core::kStageCount] = {};
};

// A pair whose patches are to be made. gaps: the place in ContactView::hull_gaps, or kNoGaps.
struct NearPair {
  core::Pair pair;
  std::uint32_t gaps = 0;
};
inline constexpr std::uint32_t kNoGaps = 0xFFFFFFFFU;

// The host plans a step before it knows how fast the step begins. Its plan is right for paces from `least` to `most`;
// at other paces the frame is repeated. The pace is 0 where no body is faster than calm_m_s, otherwise the bits of the
// stride, at least 1.
struct PlannedPace {
  std::uint32_t calm_m_s = 0;
  std::uint32_t least = 0;
  std::uint32_t most = 0xFFFFFFFFU;
};

// Fixed during a run, except for the pointers that are swapped after every step.
struct ContactView {
  std::uint32_t body_count = 0;
  core::Levels levels = core::Levels::kC;
  bool has_broad = true;           // else the levels test all pairs of bodies
  bool has_long_contacts = false;  // some shapes are hulls or meshes
  bool follows_ways = false;       // some bodies are swept along their way, their path in the step
  core::Box domain;

  const RigidShapeView* shapes = nullptr;
  const std::uint32_t* shape_of_body = nullptr;
  const std::uint8_t* is_swept = nullptr;  // [bodies] 1: swept; set where follows_ways
  const core::RigidMass* mass = nullptr;
  const core::Material* material = nullptr;
  const core::ContactShape* face_shapes = nullptr;  // [6]
  const core::ContactPose* face_poses = nullptr;    // [6]

  std::uint8_t* asleep = nullptr;  // [bodies] 1: asleep; null where bodies never sleep

  const core::RigidState* before = nullptr;  // at the start of the step, which is the pose of detection
  // At detection, as core::RigidBodies has them.
  core::ContactPose* free_end = nullptr;
  PackedPusher* pushers = nullptr;
  // core::PushWord, the strongest push of each body: noted along candidate pairs, and passed on along confirmed pairs.
  // The old ones were noted in the step before, the others are for the next step.
  const unsigned long long* old_push = nullptr;
  const unsigned long long* old_passed_on = nullptr;
  unsigned long long* push = nullptr;
  unsigned long long* passed_on = nullptr;
  float* reach_m = nullptr;
  float* fall_m = nullptr;
  std::uint32_t* pushed_m = nullptr;  // bits of a float, m: the largest reach of a neighbor
  core::Box* shape_boxes = nullptr;
  PackedBox* boxes = nullptr;  // low_tag = body, high_tag: 1 = static

  const core::Pair* pairs = nullptr;
  std::uint64_t pair_capacity = 0;
  const Counters* broad_counters = nullptr;
  AppendView<core::Pair> confirmed;
  core::Pair* fresh = nullptr;  // [confirmed.capacity]; null where no shape is a hull: all pairs are fresh
  NearPair* near = nullptr;     // [confirmed.capacity]
  // Pairs of finely cut hulls that may touch, [confirmed.capacity]: the array is filled from its end with those that
  // are clearly apart, from its beginning with the others. Null where no shape is a hull.
  core::Pair* hulls = nullptr;
  core::KnownGaps* hull_gaps = nullptr;
  AppendView<core::ContactPatch> patches;  // those of one pair follow each other
  PatchMemory memory;                      // of this step
  PatchMemory old_memory;                  // of the step before

  RigidCounts* counts = nullptr;
  unsigned long long* barrier = nullptr;
  RigidOutcome* outcome = nullptr;
  // The cells of the broad phase were chosen for boxes within these limits, bits of floats. A frame with a box that is
  // longer, or farther from the origin, is repeated.
  std::uint32_t side_limit = 0;
  std::uint32_t coordinate_limit = 0;
  PlannedPace planned;
};

}  // namespace broadside::gpu
