// Loops over constraints and bodies while contacts are solved.
//
// A sweep solves patches in the order of their colors. Unless there are some hundred thousand patches, its time is the
// time for which patches wait for each other plus the chain of operations of each patch. Everything below serves to
// shorten these two:
// - A patch waits only for its two bodies, and a body only for its patches (versions.cuh). A substep of soft steps in
//   which nothing bounces has no barrier.
// - Lanes that wait go on together (wait_until). When each lane went on as soon as it could, a warp ran the code after
//   the wait several times.
// - The four points of a patch and both its bodies lie in registers: loops over points have a fixed length, without a
//   branch (core::each_point_or_zeros), and a thread may have 255 registers.
// - A thread loads its next constraint ahead, and computes what follows from the bodies' places alone: gaps, and how
//   fast they may close (core::goals_of). Once the bodies are ready, only velocities are loaded.
// - No loop but the sweeps goes over all constraints: the next sweep adds up totals, and the last relaxation notes
//   which points bounce.
// - Impulses that are known beforehand need no colors (kept_impulses.cuh). While contacts bounce, a sweep visits only
//   patches whose bodies have just changed (bounce_sweeps.cuh); this set changes during the sweep, so there are
//   barriers between its colors.
// - A patch that approaches too slowly to bounce gets restitution 0 for the step (core::note_approach). Restitution
//   lies in a word that all sweeps read, so approaches and totals are read only of patches that may bounce.
#pragma once

#include "core/method/rigid/patch_constraint.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/chosen_turns.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solve_team.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"
#include "gpu/stages/rigid/versions.cuh"

namespace broadside::gpu {

// work(i) for every body, always by the same thread. No barrier. The last threads have the first bodies, so that few
// threads have both patches and bodies: the threads of bodies wait for versions while others solve patches.
template <typename Work>
__device__ __forceinline__ void each_body(const SolveTeam& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t i = team.size() - 1 - team.spread_rank(); i < f.body_count; i += team.size())
    work(static_cast<std::uint32_t>(i));
}
// The same as work(i, loaded), with loaded = load(i), once ready(i, loaded) is true.
template <typename Load, typename Ready, typename Work>
__device__ __forceinline__ void each_body_in_turn(const SolveTeam& team, const RigidFrameView& f, const Load& load,
                                                  const Ready& ready, const Work& work) {
  std::uint64_t k = team.size() - 1 - team.spread_rank();
  for (; __any_sync(kFullWarp, k < f.body_count); k += team.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    const bool has = k < f.body_count;
    decltype(load(i)) loaded;
    if (has) loaded = load(i);
    wait_until(has, [&] { return ready(i, loaded); });
    if (has) work(i, loaded);
  }
}

// work(slot, place) for every constraint, in any order, so it must not change a body that another constraint reads. No
// barrier.
template <typename Work>
__device__ __forceinline__ void each_place(const SolveTeam& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t place = team.spread_rank(); place < f.counts->places; place += team.size())
    if (f.patch_at[place] != kUncolored) work(team.slot(place), place);
}

// What a thread waits for before it goes on with the next color, in sweeps with barriers.
enum class ColorWait : std::uint8_t { kNothing, kTeam, kBlock };

// For a sweep whose work writes everything itself.
struct KeepsNothing {
  template <typename Loaded>
  __device__ void operator()(const TileSlot& /*slot*/, std::uint32_t /*place*/, const Loaded& /*loaded*/) const {}
};

// work(slot, place, loaded) for every patch, in the order of colors. load(slot) loads what is needed of the constraint.
// A patch waits only until placed(loaded) has loaded its bodies' places, and until ready(loaded) has loaded their
// velocities. In between, aim(slot, loaded) computes what needs no velocity; after work, keep(slot, place, loaded)
// writes what no other patch waits for. A warp solves 32 patches of one color, then its next 32. All warps of the grid
// go through the places in this order, so one of them can always go on.
template <typename Load, typename Placed, typename Aim, typename Ready, typename Work, typename Keep>
__device__ __forceinline__ void each_place_in_turn(const SolveTeam& team, const RigidFrameView& f, const Load& load,
                                                   const Placed& placed, const Aim& aim, const Ready& ready,
                                                   const Work& work, const Keep& keep) {
  decltype(load(TileSlot())) loaded;
  const std::uint64_t places = f.counts->places;
  std::uint64_t place = team.spread_rank();
  const auto is_patch = [&](std::uint64_t at) { return at < places && f.patch_at[at] != kUncolored; };
  bool has = is_patch(place);
  while (place - lane() < places) {
    const TileSlot slot = team.slot(place);
    if (has) loaded = load(slot);
    const std::uint64_t next = place + team.size();
    const bool has_next = is_patch(next);
    wait_until(has, [&] { return placed(loaded); });
    if (has) aim(slot, loaded);
    wait_until(has, [&] { return ready(loaded); });
    if (has) {
      work(slot, place, loaded);
      keep(slot, place, loaded);
    }
    place = next;
    has = has_next;
  }
  team.end_version();
}

// work(slot, place, loaded) color by color, for the patches that a sweep visits, with a barrier between two colors and
// none at the end. keep(slot, place, loaded) writes what no other patch waits for. It is called after the thread has
// arrived at the barrier, because a barrier waits until everything written before it is visible. load(slot) loads what
// work needs of the constraint, and what no sweep changes of its bodies. A thread loads its next constraint right after
// its last one, mostly some colors ahead; it may, because only this thread writes that constraint during a sweep.
//
// load and work are each called at one place of the code, because they are long: with a copy of load at every barrier
// the solver's code was several times larger than a multiprocessor's instruction cache, and warps waited for
// instructions.
//
// visits: which patches the sweep chooses in large colors (Visits). There nothing is loaded ahead.
template <typename Load, typename Work, typename Keep, typename Visited>
__device__ __forceinline__ void each_visited_by_color(const SolveTeam& team, const Load& load, const Work& work,
                                                      const Keep& keep, const Visited& visits) {
  decltype(load(TileSlot())) loaded;
  ChosenTurns chosen(team);
  const std::uint32_t chosen_until = visits.is_used ? team.chosen_until() : 0;
  if (chosen_until > 0) chosen.begin(0);
  ColorTurn turn = chosen_until > 0 ? ColorTurn{} : team.turn_from(0);
  bool is_loaded = false;
  bool owes = false;
  std::uint32_t owed = 0;
  ColorWait wait = ColorWait::kNothing;
  for (std::uint32_t color = 0;;) {
    if (owes) keep(team.slot(owed), owed, loaded);
    owes = false;
    // A load ahead waits until the thread has arrived at the barrier after its last turn of a color.
    const bool loads = wait != ColorWait::kNothing || turn.color == color;
    if (loads && !is_loaded && turn.color != kNoColor) {
      loaded = load(team.slot(turn.place));
      is_loaded = true;
    }
    if (wait == ColorWait::kTeam) team.wait();
    if (wait == ColorWait::kBlock) __syncthreads();
    wait = ColorWait::kNothing;
    // Lanes that load again do so before any lane of the warp works, so that all work at once.
    const bool is_stale = turn.color == color && visits.is_stale(loaded);
    is_loaded &= !is_stale;
    if (__any_sync(kFullWarp, is_stale)) continue;
    if (turn.color == color) {
      work(team.slot(turn.place), turn.place, loaded);
      owes = true;
      owed = turn.place;
      turn = color < chosen_until ? chosen.next() : team.turn_after(turn);
      is_loaded = false;
    }
    if (__any_sync(kFullWarp, turn.color == color)) continue;
    if (color < chosen_until && chosen.has_more()) {
      turn = chosen.choose(visits);
      continue;
    }
    if (++color >= team.colors()) break;
    if (color < chosen_until) chosen.begin(color);
    if (color == chosen_until) turn = team.turn_from(color);
    if (color <= team.alone_from()) {
      team.arrive();
      wait = ColorWait::kTeam;
    } else if (blockIdx.x == 0) {
      wait = ColorWait::kBlock;
    } else {
      break;
    }
  }
  if (owes) keep(team.slot(owed), owed, loaded);
}

// Loads the velocities of a patch's bodies, calls work(), which changes a and b, and stores them. All other parts of a
// and b have been loaded.
template <typename Work>
__device__ __forceinline__ void with_velocities(const SolveTeam& team, const RigidFrameView& f,
                                                const core::PatchConstraint& c, core::SolverBody& a,
                                                core::SolverBody& b, const Work& work) {
  load_velocity(f.bodies[c.a], a);
  load_velocity(f.bodies[c.b], b);
  work();
  store_velocity(f.bodies[c.a], a, team.version());
  store_velocity(f.bodies[c.b], b, team.version());
}

}  // namespace broadside::gpu
