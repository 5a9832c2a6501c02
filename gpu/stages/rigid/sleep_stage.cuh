// Islands that stand still stop being solved: RIGID 8.8. The same as reference/octree_cpu/rigid/sleepers.cpp.
#pragma once

#include "core/contact.hpp"
#include "core/method/rigid/sleep.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/frame_end.cuh"

namespace broadside::gpu {

__device__ inline bool is_patch_asleep(const ContactView& f, const core::ContactPatch& patch) {
  return is_asleep(f, patch.a) || is_asleep(f, patch.b);
}

// If the k-th patch is the first one of its pair: how many patches of `count` belong to that pair. Otherwise 0.
template <typename PatchAt>
__device__ std::uint32_t patches_of_pair(std::uint64_t k, std::uint64_t count, const PatchAt& patch_at) {
  const core::ContactPatch& first = patch_at(k);
  const auto is_same = [&](std::uint64_t other) {
    return patch_at(other).a == first.a && patch_at(other).b == first.b;
  };
  if (k > 0 && is_same(k - 1)) return 0;
  std::uint32_t found = 1;
  while (k + found < count && is_same(k + found)) ++found;
  return found;
}

__device__ inline void wake_if_touched(const RigidFrameView& f, std::uint32_t sleeper, std::uint32_t other) {
  if (!is_asleep(f, sleeper) || !is_moved(f, other) || is_asleep(f, other)) return;
  f.sleep.restless[f.sleep.island[sleeper]] = 1;
  f.counts->woken = 1;
}

template <typename Team>
__device__ void wake_islands(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    if (f.asleep[i] == 0 || f.sleep.restless[f.sleep.island[i]] == 0) continue;
    f.asleep[i] = 0;
    f.sleep.still[i] = 0;
  }
}

// Sleeping bodies keep their patches, which are stored behind those that are solved.
template <typename Team>
__device__ void keep_asleep_patches(const Team& team, const RigidFrameView& f) {
  const std::uint64_t count = f.sleep.old_count;
  for (std::uint64_t of_warp = team.rank() - lane(); of_warp < count; of_warp += team.size()) {
    const std::uint64_t k = of_warp + lane();
    const auto patch_at = [&](std::uint64_t n) -> const core::ContactPatch& { return f.sleep.old[n].patch; };
    const bool is_kept = k < count && is_patch_asleep(f, f.sleep.old[k].patch);
    const std::uint32_t found = is_kept ? patches_of_pair(k, count, patch_at) : 0;
    const std::uint64_t first = warp_append(found, &f.counts->patches);
    warp_append(found, &f.counts->asleep_patches);
    if (found == 0 || first + found > f.patches.capacity) continue;
    for (std::uint32_t n = 0; n < found; ++n) {
      const AsleepPatch& old = f.sleep.old[k + n];
      const std::uint64_t at = first + n;
      f.patches.items[at] = old.patch;
      for (std::uint32_t point = 0; point < core::kManifoldPoints; ++point) {
        f.impulses[4 * at + point] = f.sleep.share * old.impulses[point];
        f.memory.feature[4 * at + point] = old.feature[point];
        f.memory.impulse[4 * at + point] = old.remembered[point];
      }
    }
    if (is_moved(f, f.sleep.old[k].patch.a)) atomicAdd(&f.memory.count[f.sleep.old[k].patch.a], found);
    if (is_moved(f, f.sleep.old[k].patch.b)) atomicAdd(&f.memory.count[f.sleep.old[k].patch.b], found);
  }
}

// Wakes islands; it runs after the patches of awake bodies are known. A body that wakes may touch others that sleep. So
// the frame is aborted when an island wakes, and begins again from the same state with that island awake.
__device__ inline void run_wake(const RigidFrameView& f) {
  const GridTeam grid(f.barrier);
  if (lacks_pairs(f) || f.counts->confirmed > f.confirmed.capacity || f.counts->patches > f.patches.capacity) return;
  const std::uint64_t patches = f.counts->patches;
  for (std::uint64_t k = grid.rank(); k < patches; k += grid.size()) {
    const core::ContactPatch& patch = f.patches.items[k];
    wake_if_touched(f, patch.a, patch.b);
    wake_if_touched(f, patch.b, patch.a);
  }
  grid.sync();
  if (f.counts->woken != 0)
    wake_islands(grid, f);
  else
    keep_asleep_patches(grid, f);
}

// Union-find: the lowest body of an island is its root. A body's parent is never above the body, and only falls while
// islands grow.
__device__ inline std::uint32_t root_of(const RigidFrameView& f, std::uint32_t body) {
  const volatile std::uint32_t* parent = f.sleep.parent;
  for (std::uint32_t above = parent[body]; above != body; above = parent[body]) body = above;
  return body;
}

__device__ inline void join_islands(const RigidFrameView& f, std::uint32_t a, std::uint32_t b) {
  for (;;) {
    a = root_of(f, a);
    b = root_of(f, b);
    if (a == b) return;
    const std::uint32_t high = max(a, b);
    if (atomicCAS(&f.sleep.parent[high], high, min(a, b)) == high) return;
  }
}

template <typename Team>
__device__ void join_touching(const Team& team, const RigidFrameView& f, std::uint64_t patches) {
  for (std::uint64_t k = team.rank(); k < patches; k += team.size()) {
    const std::uint32_t a = f.patches.items[k].a;
    const std::uint32_t b = f.patches.items[k].b;
    if (is_moved(f, a) && is_moved(f, b)) join_islands(f, a, b);
  }
}

// Counts for how long bodies have been still. A body that moves, or has not been still for long enough, keeps its
// island awake.
template <typename Team>
__device__ void find_restless(const Team& team, const RigidFrameView& f) {
  std::uint32_t asleep = 0;
  for (std::uint64_t k = team.rank(); k < f.body_count; k += team.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    if (!is_moved(f, i)) continue;
    if (is_asleep(f, i)) {
      ++asleep;
      continue;
    }
    const float outer_m = f.shapes[f.shape_of_body[i]].balls.outer_m;
    const std::uint32_t still = core::still_steps(f.sleep.still[i], f.after[i], f.mass[i], outer_m, f.sleep.speed_m_s);
    f.sleep.still[i] = still;
    if (still < core::still_steps_to_sleep(outer_m, f.gravity_m_s2, f.step_s)) f.sleep.restless[root_of(f, i)] = 1;
  }
  if (asleep != 0) atomicAdd(&f.counts->asleep_bodies, static_cast<unsigned long long>(asleep));
}

template <typename Team>
__device__ void fall_asleep(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t k = team.rank(); k < f.body_count; k += team.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    if (!is_moved(f, i) || is_asleep(f, i)) continue;
    const std::uint32_t island = root_of(f, i);
    if (f.sleep.restless[island] != 0) continue;
    f.asleep[i] = 1;
    f.sleep.island[i] = island;
    f.after[i] = core::stopped(f.after[i]);
  }
}

// Stores the patches of sleeping bodies for the next step.
template <typename Team>
__device__ void note_asleep_patches(const Team& team, const RigidFrameView& f, std::uint64_t patches) {
  for (std::uint64_t of_warp = team.rank() - lane(); of_warp < patches; of_warp += team.size()) {
    const std::uint64_t k = of_warp + lane();
    const auto patch_at = [&](std::uint64_t n) -> const core::ContactPatch& { return f.patches.items[n]; };
    const bool is_kept = k < patches && is_patch_asleep(f, f.patches.items[k]);
    const std::uint32_t found = is_kept ? patches_of_pair(k, patches, patch_at) : 0;
    const std::uint64_t first = warp_append(found, &f.counts->asleep_patches);
    for (std::uint32_t n = 0; n < found; ++n) {
      AsleepPatch& now = f.sleep.now.items[first + n];
      now.patch = f.patches.items[k + n];
      for (std::uint32_t point = 0; point < core::kManifoldPoints; ++point) {
        const std::uint64_t at = 4 * (k + n) + point;
        now.impulses[point] = f.impulses[at];
        now.feature[point] = f.memory.feature[at];
        now.remembered[point] = f.memory.impulse[at];
      }
    }
  }
}

// Call after the solver's launch, which left the counts that it told the host.
__device__ inline void run_fall_asleep(const RigidFrameView& f) {
  const GridTeam grid(f.barrier);
  if (f.counts->told_is_aborted != 0) return;
  const std::uint64_t patches = f.counts->told_patches;
  if (f.sleep.decides) {
    for (std::uint64_t i = grid.rank(); i < f.body_count; i += grid.size()) {
      f.sleep.parent[i] = static_cast<std::uint32_t>(i);
      f.sleep.restless[i] = 0;
    }
    grid.sync();
    join_touching(grid, f, patches);
    grid.sync();
    find_restless(grid, f);
    grid.sync();
    fall_asleep(grid, f);
    grid.sync();
  }
  note_asleep_patches(grid, f, patches);
  grid.sync();
  if (grid.rank() != 0) return;
  f.outcome->counts.asleep_bodies = f.counts->asleep_bodies;
  f.outcome->counts.asleep_patches = f.counts->asleep_patches;
  f.counts->asleep_bodies = 0;
  f.counts->asleep_patches = 0;
}

}  // namespace broadside::gpu
