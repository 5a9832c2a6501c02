// Colors of patches: those of one color share no moved body. The same function of the set of patches as the twin's
// (reference/octree_cpu/rigid/patch_coloring.hpp): in the order of their priorities each patch takes the lowest color
// that no earlier patch of its moved bodies has.
#pragma once

#include "core/method/coloring.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/patch_stage.cuh"

namespace broadside::gpu {

// The number of this body's patches that come before.
__device__ inline std::uint32_t rank_among(const RigidFrameView& f, std::uint32_t body, std::uint32_t patch,
                                           std::uint64_t priority) {
  if (!is_moved(f, body)) return kNotMoved;
  const PatchEntry* entries = f.memory.entries + f.memory.begin[body];
  std::uint32_t rank = 0;
  for (std::uint32_t k = 0; k < f.memory.count[body]; ++k) {
    const PatchEntry entry = entries[k];
    const std::uint64_t other = core::color_priority(core::make_pair_of(body, entry.other));
    if (other < priority || (other == priority && entry.patch < patch)) ++rank;
  }
  return rank;
}

template <typename Team>
__device__ void rank_patches(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t k = team.rank(); k < f.counts->patches; k += team.size()) {
    const std::uint32_t a = f.patches.items[k].a;
    const std::uint32_t b = f.patches.items[k].b;
    const std::uint64_t priority = core::color_priority({a, b});
    const auto patch = static_cast<std::uint32_t>(k);
    if (!core::is_face(b))
      atomicMax(&f.counts->mass_ratio,
                __float_as_uint(core::mass_ratio(f.mass[a].inverse_mass, f.mass[b].inverse_mass)));
    f.ranks[k] = {rank_among(f, a, patch, priority), rank_among(f, b, patch, priority), kUncolored, 0};
  }
}

constexpr std::uint32_t kFewColors = 64;

__device__ inline uint4 colors_of(const RigidFrameView& f, std::uint32_t body, std::uint32_t rank) {
  if (rank == kNotMoved) return {0, 0, 0, kNotMoved};
  return GridWords::load_whole(reinterpret_cast<const uint4*>(f.coloring + body));
}

__device__ inline void take_color(const RigidFrameView& f, std::uint32_t body, std::uint32_t rank, uint4 colors,
                                  std::uint32_t color) {
  if (rank == kNotMoved) return;
  if (color < 32)
    colors.x |= 1U << color;
  else if (color < kFewColors)
    colors.y |= 1U << (color - 32);
  else
    colors.z = color + 1;
  colors.w = rank + 1;
  GridWords::store_whole(reinterpret_cast<uint4*>(f.coloring + body), colors);
}

// Whether its turn has come, and it has a color now.
__device__ inline bool try_color(const RigidFrameView& f, std::uint64_t k) {
  PatchRank& own = f.ranks[k];
  const std::uint32_t a = f.patches.items[k].a;
  const std::uint32_t b = f.patches.items[k].b;
  const uint4 of_a = colors_of(f, a, own.a);
  const uint4 of_b = colors_of(f, b, own.b);
  if (of_a.w != own.a || of_b.w != own.b) return false;
  const unsigned low = of_a.x | of_b.x;
  const unsigned high = of_a.y | of_b.y;
  std::uint32_t color = kFewColors;
  if (low != 0xFFFFFFFFU)
    color = static_cast<std::uint32_t>(__ffs(static_cast<int>(~low)) - 1);
  else if (high != 0xFFFFFFFFU)
    color = 32 + static_cast<std::uint32_t>(__ffs(static_cast<int>(~high)) - 1);
  else
    color = max(kFewColors, max(of_a.z, of_b.z));
  take_color(f, a, own.a, of_a, color);
  take_color(f, b, own.b, of_b, color);
  own.color = color;
  if (color < f.color_capacity) atomicAdd(&f.color_count[color], 1U);
  atomicMax(&f.counts->colors, color + 1);
  return true;
}

// Rounds until all have a color; a patch waits for the earlier ones of its bodies alone.
template <typename Team>
__device__ void color_patches(const Team& team, const RigidFrameView& f) {
  const std::uint64_t patches = f.counts->patches;
  for (std::uint32_t round = 0;; ++round) {
    // The next round's count is cleared while nobody reads or writes it.
    if (team.rank() == 0) f.counts->uncolored[(round + 1) % 3] = 0;
    std::uint32_t left = 0;
    for (std::uint64_t k = team.rank(); k < patches; k += team.size())
      if (f.ranks[k].color == kUncolored && !try_color(f, k)) ++left;
    if (left != 0) atomicAdd(&f.counts->uncolored[round % 3], left);
    team.sync();
    if (f.counts->uncolored[round % 3] == 0) return;
  }
}

// By one thread. A color's places begin at a multiple of 32, so that a warp's constraints lie together.
__device__ inline void place_colors(const RigidFrameView& f) {
  std::uint32_t next = 0;
  for (std::uint32_t color = 0; color < f.counts->colors; ++color) {
    f.color_begin[color] = next;
    f.color_cursor[color] = 0;
    next += (f.color_count[color] + 31) / 32 * 32;
  }
  f.color_begin[f.counts->colors] = next;
  f.counts->places = next;
}

// Enters a patch's place in the list of one of its bodies, which is in the order of colors: no two of a body's patches
// have the same.
__device__ inline void list_by_color(const RigidFrameView& f, std::uint32_t body, std::uint32_t color,
                                     std::uint32_t place, std::uint32_t side) {
  if (!is_moved(f, body)) return;
  const std::uint32_t begin = f.memory.begin[body];
  std::uint32_t before = 0;
  for (std::uint32_t k = 0; k < f.memory.count[body]; ++k)
    if (f.ranks[f.memory.entries[begin + k].patch].color < color) ++before;
  f.by_color[begin + before] = 2 * place + side;
}

template <typename Team>
__device__ void place_patches(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t k = team.rank(); k < f.counts->patches; k += team.size()) {
    const std::uint32_t color = f.ranks[k].color;
    const std::uint32_t place = f.color_begin[color] + atomicAdd(&f.color_cursor[color], 1U);
    f.patch_at[place] = static_cast<std::uint32_t>(k);
    list_by_color(f, f.patches.items[k].a, color, place, 0);
    list_by_color(f, f.patches.items[k].b, color, place, 1);
  }
  for (std::uint64_t color = team.rank(); color < f.counts->colors; color += team.size())
    for (std::uint32_t place = f.color_begin[color] + f.color_count[color]; place < f.color_begin[color + 1]; ++place)
      f.patch_at[place] = kUncolored;
}

}  // namespace broadside::gpu
