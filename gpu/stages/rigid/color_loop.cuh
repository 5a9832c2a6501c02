// Loops over constraints and bodies while contacts are solved.
#pragma once

#include "core/method/rigid/patch_constraint.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solve_team.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"

namespace broadside::gpu {

// work(i) for every body. No barrier.
template <typename Work>
__device__ __forceinline__ void each_body(const SolveTeam& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t i = team.spread_rank(); i < f.body_count; i += team.size()) work(static_cast<std::uint32_t>(i));
}

// work(slot, place) for every constraint, in any order: it reads bodies alone. No barrier.
template <typename Work>
__device__ __forceinline__ void each_place(const SolveTeam& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t place = team.spread_rank(); place < f.counts->places; place += team.size())
    if (f.patch_at[place] != kUncolored) work(TileSlot(f.constraints, place), place);
}

// work(a, b) changes the velocities of a patch's two bodies.
template <typename Work>
__device__ __forceinline__ void with_bodies(const RigidFrameView& f, const core::PatchConstraint& c, const Work& work) {
  core::SolverBody a = load_moving(f.bodies[c.a]);
  core::SolverBody b = load_moving(f.bodies[c.b]);
  work(a, b);
  store_velocity(f.bodies[c.a], a);
  store_velocity(f.bodies[c.b], b);
}

// A thread's places of one color.
struct ColorTurn {
  std::uint64_t place = 0;
  std::uint64_t end = 0;
  std::uint64_t step = 0;
};

// Every sweep deals places out alike.
__device__ __forceinline__ ColorTurn turn_of(const SolveTeam& team, const RigidFrameView& f, std::uint32_t color) {
  const bool is_alone = color >= team.alone_from();
  if (color >= team.colors() || (is_alone && blockIdx.x != 0)) return {};
  const std::uint64_t begin = f.color_begin[color];
  return {begin + (is_alone ? threadIdx.x : team.spread_rank()), begin + f.color_count[color],
          is_alone ? blockDim.x : team.size()};
}

// work(slot, place, loaded) color by color, with a barrier between two colors and none at the end. load(slot) gives
// what work needs of the constraint. The first constraint of a color is loaded while the thread waits for the others:
// nobody but this thread writes it during a sweep.
template <typename Load, typename Work>
__device__ __forceinline__ void each_place_by_color(const SolveTeam& team, const RigidFrameView& f, const Load& load,
                                                    const Work& work) {
  decltype(load(TileSlot(nullptr, 0))) loaded;
  ColorTurn turn = turn_of(team, f, 0);
  const auto load_first = [&] {
    if (turn.place < turn.end) loaded = load(TileSlot(f.constraints, turn.place));
  };
  load_first();
  for (std::uint32_t color = 1;; ++color) {
    const ColorTurn next = turn_of(team, f, color);  // asked for now, used behind this color's work
    while (turn.place < turn.end) {
      work(TileSlot(f.constraints, turn.place), turn.place, loaded);
      turn.place += turn.step;
      load_first();
    }
    if (color >= team.colors()) return;
    turn = next;
    if (color <= team.alone_from()) {
      team.sync(load_first);
    } else if (blockIdx.x == 0) {
      load_first();
      __syncthreads();
    } else {
      return;
    }
  }
}

}  // namespace broadside::gpu
