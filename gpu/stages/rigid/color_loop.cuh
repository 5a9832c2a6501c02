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

// work(slot, place, loaded) color by color, with a barrier between two colors and none at the end. load(slot) gives
// what work needs of the constraint. The first constraint of a color is loaded while the thread waits for the others:
// nobody but this thread writes it during a sweep, because every sweep deals constraints out alike.
template <typename Load, typename Work>
__device__ __forceinline__ void each_place_by_color(const SolveTeam& team, const RigidFrameView& f, const Load& load,
                                                    const Work& work) {
  const std::uint32_t colors = f.counts->colors;
  if (colors == 0) return;
  const std::uint64_t first = team.spread_rank();
  std::uint64_t place = first;  // the first color begins at place 0
  std::uint64_t end = f.color_count[0];
  decltype(load(TileSlot(nullptr, 0))) loaded;
  if (place < end) loaded = load(TileSlot(f.constraints, place));
  for (std::uint32_t color = 1;; ++color) {
    // Asked for now, used behind this color's work.
    const bool is_last = color == colors;
    const std::uint64_t next_begin = is_last ? 0 : f.color_begin[color];
    const std::uint64_t next_count = is_last ? 0 : f.color_count[color];
    while (place < end) {
      work(TileSlot(f.constraints, place), place, loaded);
      place += team.size();
      if (place < end) loaded = load(TileSlot(f.constraints, place));
    }
    if (is_last) return;
    place = next_begin + first;
    end = next_begin + next_count;
    team.sync([&] {
      if (place < end) loaded = load(TileSlot(f.constraints, place));
    });
  }
}

}  // namespace broadside::gpu
