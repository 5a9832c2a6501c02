// What the kernels of a frame of turning bodies are given, by value: where everything of one simulation lies on the
// device. RIGID 8; the twin is reference/octree_cpu/rigid.
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
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "core/pair.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Of a mesh and a center of mass in it; its pointers are the device's.
struct RigidShapeView {
  core::ContactShape contact;
  const core::NodeBoxes* nodes = nullptr;
  core::VertexTreeView vertices;
  core::ShapeBalls balls;
};

// A patch in the list of one of its moved bodies.
struct alignas(8) PatchEntry {
  std::uint32_t patch = 0;
  std::uint32_t other = 0;  // the other body, or a face
};

// Each moved body's patches, in no order, and the impulses that the last substep left in them: what the next step
// begins with. One of the step before, one of this step.
struct PatchMemory {
  std::uint32_t* begin = nullptr;    // [bodies]
  std::uint32_t* count = nullptr;    // [bodies]; 0 of bodies that never move
  std::uint32_t* filled = nullptr;   // [bodies] entries that are there already
  PatchEntry* entries = nullptr;     // [2 * patches]
  std::uint32_t* feature = nullptr;  // [4 * patches]; 0 = no point
  PackedVec3* impulse = nullptr;     // [4 * patches] N: friction on A, and w = along the normal
};

// A patch's place among the patches of each of its bodies, in the order in which they are colored; kNotMoved for a body
// that never moves.
struct alignas(16) PatchRank {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t color = 0;
  std::uint32_t unused = 0;
};
constexpr std::uint32_t kNotMoved = 0xFFFFFFFFU;
constexpr std::uint32_t kUncolored = 0xFFFFFFFFU;

// What the coloring knows of a body: one word of 16 bytes, so that a reader sees all of it at one moment.
struct alignas(16) BodyColors {
  std::uint32_t taken_low = 0;   // bit c: color c
  std::uint32_t taken_high = 0;  // bit c: color 32 + c
  std::uint32_t next = 0;        // the least color from 64 on that is free
  std::uint32_t colored = 0;     // how many of its patches have a color
};

// What a pair needs of a body to say what it does to the other one: core::Pusher.
struct alignas(16) PackedPusher {
  PackedVec3 drift;   // w: what turning adds
  PackedVec3 pushed;  // w: who drives it, as a word
};

// core::SolverBody in words of 16 bytes; those that sweeps over patches read come first, those that they write before
// all others: 32 bytes, which is how much memory is read at least.
struct alignas(128) PackedSolverBody {
  PackedVec3 v;                 // w: inverse mass
  PackedVec3 angular_momentum;  // w: xx of the inverse inertia
  PackedVec3 inertia;           // yy zz xy, w: xz
  PackedVec3 moved;             // w: yz
  PackedVec3 turned;
  core::Quat q;
  core::Quat q_rest;
};
static_assert(sizeof(PatchRank) == 16 && sizeof(BodyColors) == 16 && sizeof(PackedSolverBody) == 128,
              "read and written in words of 16 bytes");

// Whose barriers the solver's kernel has: all its blocks'. A cluster's is the fastest.
enum class SolveTeamKind : std::uint8_t { kGrid, kCluster };

// Counts of one frame; all are what was demanded. A new frame's place kernel sets them to zero.
struct RigidCounts {
  unsigned long long confirmed = 0;
  unsigned long long patches = 0;
  unsigned long long listed = 0;  // places given out in the lists of bodies
  unsigned long long places = 0;  // of constraints: patches, and the gaps between colors
  // Nonnegative floats, as words: they are ordered like the floats. What is not finite is above all that is.
  std::uint32_t largest_side = 0;
  std::uint32_t largest_coordinate = 0;
  std::uint32_t colors = 0;
  std::uint32_t bounces = 0;     // 1: a patch has restitution
  std::uint32_t mass_ratio = 0;  // the largest of two bodies that touch, as a word
  std::uint32_t is_aborted = 0;
  std::uint32_t uncolored[3] = {};  // in turns, a round each
  // What all threads bring together, in turns (team_sums.cuh).
  std::uint32_t largest[4][2] = {};
  unsigned long long sums[4] = {};
};

// What the host reads after a frame, in host memory that the device writes.
struct RigidOutcome {
  RigidCounts counts;
  unsigned long long begin_ns = 0;
  unsigned long long stage_end_ns[core::kStageCount] = {};
};

// Fixed during a run, but for before and after and the two memories, which change places after every step.
struct RigidFrameView {
  std::uint32_t body_count = 0;
  core::Levels levels = core::Levels::kC;
  bool has_broad = true;  // else the levels test all pairs of bodies
  float dt_s = 0.0F;
  core::Vec3 gravity_m_s2;
  core::Box domain;
  core::Material face_material;
  core::SoftSettings solver;
  // Of even masses, and of masses further apart than even_masses: their substeps.
  core::SoftStep soft[2];
  std::uint32_t substeps[2] = {};

  const RigidShapeView* shapes = nullptr;
  const std::uint32_t* shape_of_body = nullptr;
  const core::RigidMass* mass = nullptr;
  const core::Material* material = nullptr;
  const core::RigidWrench* wrench = nullptr;        // null: none
  const core::ContactShape* face_shapes = nullptr;  // [6]
  const core::ContactPose* face_poses = nullptr;    // [6]

  const core::RigidState* before = nullptr;  // at the start of the step, which is the pose of detection
  core::RigidState* after = nullptr;
  // Of detection, as core::RigidBodies has them.
  core::ContactPose* free_end = nullptr;
  PackedPusher* pushers = nullptr;
  const unsigned long long* old_push = nullptr;  // core::PushWord, from the step before
  unsigned long long* push = nullptr;            // for the next step
  float* reach_m = nullptr;
  float* fall_m = nullptr;
  std::uint32_t* pushed_m = nullptr;  // as a word: the reach of the neighbor that reaches farthest
  core::Box* shape_boxes = nullptr;
  PackedBox* boxes = nullptr;  // low_tag = body, high_tag: 1 = static

  const core::Pair* pairs = nullptr;
  std::uint64_t pair_capacity = 0;
  const Counters* broad_counters = nullptr;
  AppendView<core::Pair> confirmed;
  AppendView<core::ContactPatch> patches;  // those of one pair follow each other
  PatchRank* ranks = nullptr;              // [patches]
  BodyColors* coloring = nullptr;          // [bodies]
  std::uint32_t color_capacity = 0;
  std::uint32_t* color_count = nullptr;   // [colors]
  std::uint32_t* color_begin = nullptr;   // [colors + 1] first places; multiples of 32
  std::uint32_t* color_cursor = nullptr;  // [colors]
  std::uint32_t* patch_at = nullptr;      // [places] kUncolored in a gap
  std::uint64_t place_capacity = 0;
  PackedVec3* constraints = nullptr;  // constraint_tiles.cuh
  float* changes = nullptr;           // [places] J, of the last sweep (core::squared_change)
  // [2 * patches] In the lists of each moved body its patches' places by color: 2 * place, + 1 where it is body B.
  std::uint32_t* by_color = nullptr;
  SolveTeamKind solve_team = SolveTeamKind::kGrid;
  PackedSolverBody* bodies = nullptr;  // [bodies + 1]; the last one stands for every face: it never moves
  // [bodies + 1] While contacts bounce: the sweep that has to visit the body's patches, of all of the step.
  std::uint32_t* stirred = nullptr;
  core::Vec3* impulses = nullptr;  // [4 * patches] N s on A, of the whole step
  PatchMemory old_memory;
  PatchMemory memory;

  RigidCounts* counts = nullptr;
  unsigned long long* barrier = nullptr;
  RigidOutcome* outcome = nullptr;
  // A box longer, or farther out, than this was not foreseen when the broad phase got its cells: the frame is repeated.
  std::uint32_t side_limit = 0;
  std::uint32_t coordinate_limit = 0;
};

}  // namespace broadside::gpu
