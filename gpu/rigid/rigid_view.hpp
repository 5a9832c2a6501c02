// The argument, by value, of the kernels of a frame of turning bodies: the numbers of the step, and pointers to all
// device memory of one simulation. RIGID 8; the twin is reference/octree_cpu/rigid.
#pragma once

#include <cstdint>
#include <iterator>

#include "core/material.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/rigid/sleep_view.hpp"

namespace broadside::gpu {

// A patch's place in the lists of each of its bodies, in the order in which they are colored; kNotMoved for a body that
// never moves.
struct alignas(16) PatchRank {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t body_a = 0;
  std::uint32_t body_b = 0;  // or a face
};
constexpr std::uint32_t kNotMoved = 0xFFFFFFFFU;
constexpr std::uint32_t kUncolored = 0xFFFFFFFFU;

// A body's state during coloring: one word of 16 bytes, so that a reader sees all of it at one moment.
struct alignas(16) BodyColors {
  std::uint32_t taken_low = 0;   // bit c: color c
  std::uint32_t taken_high = 0;  // bit c: color 32 + c
  std::uint32_t next = 0;        // the least color from 64 on that is free
  std::uint32_t colored = 0;     // how many of its patches have a color
};

// core::SolverBody without its mass, in words of 16 bytes. First come the words that sweeps over patches write: 32
// bytes, the least that memory transfers at once. Then come those that sweeps only read. w: the version of the
// velocities, or of the place to which the body was moved (stages/rigid/versions.cuh).
struct alignas(128) PackedSolverBody {
  PackedVec3 v;
  PackedVec3 angular_momentum;
  PackedVec3 inertia_along;   // inverse: xx yy zz
  PackedVec3 inertia_across;  // xy xz yz
  PackedVec3 moved;
  PackedVec3 turned;
  core::Quat q;
  core::Quat q_rest;
};
static_assert(sizeof(PatchRank) == 16 && sizeof(BodyColors) == 16 && sizeof(PackedSolverBody) == 128,
              "read and written in words of 16 bytes");

// A body's velocities in a substep after gravity and wrenches, before any impulse.
struct alignas(32) PackedStart {
  PackedVec3 driven_v;
  PackedVec3 driven_angular_momentum;
};

// Constraints in tiles (stages/rigid/constraint_layout.hpp). has_pairs: words lie in pairs.
struct ConstraintMemory {
  PackedVec3* words = nullptr;
  bool has_pairs = false;
};

// Which barrier the solver's kernel uses: that of the whole grid, or that of a cluster, which is the fastest.
enum class SolveTeamKind : std::uint8_t { kGrid, kCluster };

// Fixed during a run, except for the pointers that are swapped after every step.
struct RigidFrameView : ContactView {
  float dt_s = 0.0F;    // of the step, or of its part
  float step_s = 0.0F;  // of the whole step
  core::Vec3 gravity_m_s2;
  core::Material face_material;
  core::SoftSettings solver;
  // By core::SolveKind: the numbers of a substep, and how many substeps there are.
  core::SoftStep soft[std::size(core::kSolveKinds)];
  std::uint32_t substeps[std::size(core::kSolveKinds)] = {};
  float calm_m_s = 0.0F;  // a step in which nothing is faster is calm; below 0: no step is

  const core::RigidWrench* wrench = nullptr;  // null: none

  core::RigidState* after = nullptr;
  PatchRank* ranks = nullptr;       // [patches]
  std::uint32_t* colors = nullptr;  // [patches]
  BodyColors* coloring = nullptr;   // [bodies]
  std::uint32_t color_capacity = 0;
  std::uint32_t* color_count = nullptr;   // [colors]
  std::uint32_t* color_begin = nullptr;   // [colors + 1] first places; multiples of 32
  std::uint32_t* color_cursor = nullptr;  // [colors]
  std::uint32_t* patch_at = nullptr;      // [places] kUncolored in a gap
  std::uint64_t place_capacity = 0;
  ConstraintMemory constraints;
  float* changes = nullptr;  // [places] J, of the last sweep (core::squared_change)
  // [2 * patches] For each moved body the places of its patches in the order of colors: 2 * place where the body is the
  // patch's A, 2 * place + 1 where it is B.
  std::uint32_t* by_color = nullptr;
  PackedSolverBody* bodies = nullptr;  // [bodies + 1]; the last one stands for every face: it never moves
  float* inverse_mass = nullptr;       // [bodies + 1] of these; 0 for sleeping bodies, too
  PackedStart* starts = nullptr;       // [bodies + 1] of the substep
  // [bodies + 1] In sweeps that visit only patches of bodies that have changed: the latest sweep, counted over the
  // step, that has to visit the body's patches.
  std::uint32_t* stirred = nullptr;
  // [bodies] The latest relaxation along directions, named by its first sweep, that has visited a patch of the body.
  std::uint32_t* relaxed = nullptr;
  core::Vec3* impulses = nullptr;  // [4 * patches] N s on A, of the whole step
  SolveTeamKind solve_team = SolveTeamKind::kGrid;
  SleepView sleep;
};

}  // namespace broadside::gpu
