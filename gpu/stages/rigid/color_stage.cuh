// Colors patches, so that patches of one color share no moved body. In the order of their priorities each patch takes
// the lowest color that no earlier patch of its moved bodies has. It is the same function of the set of patches as the
// twin's (reference/octree_cpu/rigid/patch_coloring.hpp).
#pragma once

#include "core/method/coloring.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/patch_entries.cuh"

namespace broadside::gpu {

// The number of patches that are solved. Patches of sleeping bodies lie after these and have no color.
__device__ inline std::uint64_t solved_patches(const RigidFrameView& f) {
  return f.counts->patches - f.counts->asleep_patches;
}

// How many of this body's patches are colored before this one; kNotMoved for a body that never moves.
__device__ inline std::uint32_t rank_among(const RigidFrameView& f, std::uint32_t body, std::uint32_t patch,
                                           std::uint64_t priority) {
  if (!is_moved(f, body)) return kNotMoved;
  std::uint32_t rank = 0;
  each_entry(f.memory, body, [&](const PatchEntry& entry) {
    const std::uint64_t other = core::color_priority(core::make_pair_of(body, entry.other));
    if (other < priority || (other == priority && entry.patch < patch)) ++rank;
  });
  return rank;
}

template <typename Team>
__device__ void rank_patches(const Team& team, const RigidFrameView& f) {
  float ratio = 1.0F;
  const std::uint64_t solved = solved_patches(f);
  for (std::uint64_t k = team.rank(); k < f.counts->patches; k += team.size()) {
    const std::uint32_t a = f.patches.items[k].a;
    const std::uint32_t b = f.patches.items[k].b;
    const std::uint64_t priority = core::color_priority({a, b});
    const auto patch = static_cast<std::uint32_t>(k);
    if (!core::is_face(b)) ratio = fmaxf(ratio, core::mass_ratio(f.mass[a].inverse_mass, f.mass[b].inverse_mass));
    f.colors[k] = kUncolored;
    if (k >= solved) continue;
    f.ranks[k] = {rank_among(f, a, patch, priority), rank_among(f, b, patch, priority), a, b};
  }
  __syncwarp();
  const std::uint32_t largest = warp_max(__float_as_uint(ratio));
  if (lane() == 0) atomicMax(&f.counts->mass_ratio, largest);
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

// The patch's color if its turn has come, else kUncolored.
__device__ inline std::uint32_t try_color(const RigidFrameView& f, const PatchRank& own) {
  const uint4 of_a = colors_of(f, own.body_a, own.a);
  const uint4 of_b = colors_of(f, own.body_b, own.b);
  if (of_a.w != own.a || of_b.w != own.b) return kUncolored;
  const unsigned low = of_a.x | of_b.x;
  const unsigned high = of_a.y | of_b.y;
  std::uint32_t color = kFewColors;
  if (low != 0xFFFFFFFFU)
    color = static_cast<std::uint32_t>(__ffs(static_cast<int>(~low)) - 1);
  else if (high != 0xFFFFFFFFU)
    color = 32 + static_cast<std::uint32_t>(__ffs(static_cast<int>(~high)) - 1);
  else
    color = max(kFewColors, max(of_a.z, of_b.z));
  take_color(f, own.body_a, own.a, of_a, color);
  take_color(f, own.body_b, own.b, of_b, color);
  return color;
}

// A patch waits only for the earlier patches of its bodies. A body's word is read as a whole, so no barrier is needed.
// All blocks are resident, and the first of all patches waits for no other one; so every patch gets a color.
template <typename Team>
__device__ void color_patches(const Team& team, const RigidFrameView& f) {
  const std::uint64_t patches = solved_patches(f);
  std::uint32_t colors = 0;
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (std::uint64_t k = team.rank(); k < patches; k += team.size()) {
      if (f.colors[k] != kUncolored) continue;
      const std::uint32_t color = try_color(f, f.ranks[k]);
      f.colors[k] = color;
      if (color == kUncolored)
        is_done = false;
      else
        colors = max(colors, color + 1);
    }
    if (!is_done) relax();
  }
  __syncwarp();
  colors = warp_max(colors);
  if (lane() == 0 && colors != 0) atomicMax(&f.counts->colors, colors);
}

// Calls work(color, lanes) once for each color that some lanes of a warp have. All lanes make the call; a lane without
// a patch has kUncolored.
template <typename Work>
__device__ void each_color_of_warp(std::uint32_t color, const Work& work) {
  unsigned left = __ballot_sync(kFullWarp, color != kUncolored);
  while (left != 0) {
    const std::uint32_t now = __shfl_sync(kFullWarp, color, static_cast<unsigned>(__ffs(static_cast<int>(left)) - 1));
    const unsigned lanes = __ballot_sync(kFullWarp, color == now);
    work(now, lanes);
    left &= ~lanes;
  }
}

// Counts the patches of each color. Call after a barrier.
template <typename Team>
__device__ void count_colors(const Team& team, const RigidFrameView& f) {
  const std::uint64_t patches = solved_patches(f);
  for (std::uint64_t of_warp = team.rank() - lane(); of_warp < patches; of_warp += team.size()) {
    const std::uint64_t k = of_warp + lane();
    each_color_of_warp(k < patches ? f.colors[k] : kUncolored, [&](std::uint32_t color, unsigned lanes) {
      if (lane() == 0) atomicAdd(&f.color_count[color], static_cast<std::uint32_t>(__popc(lanes)));
    });
  }
}

// By one thread. A color's places begin at a multiple of 32, so that the constraints of a warp lie together.
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

// Writes a patch's place into the list of one of its bodies, and its rank in that list into the patch. The list is in
// the order of colors; no two of a body's patches have the same color. A body that does not move has no list.
__device__ inline void list_by_color(const RigidFrameView& f, std::uint32_t body, std::uint32_t color,
                                     std::uint32_t place, std::uint32_t side) {
  const TileSlot slot(f.constraints, place);
  if (!is_moved(f, body)) {
    store_order(slot, side, PlaceInOrder());
    return;
  }
  std::uint32_t before = 0;
  each_entry(f.memory, body, [&](const PatchEntry& entry) { before += f.colors[entry.patch] < color ? 1U : 0U; });
  f.by_color[f.memory.begin[body] + before] = 2 * place + side;
  store_order(slot, side, {before, before + 1 == f.memory.count[body]});
}

template <typename Team>
__device__ void place_patches(const Team& team, const RigidFrameView& f) {
  const std::uint64_t patches = solved_patches(f);
  for (std::uint64_t of_warp = team.rank() - lane(); of_warp < patches; of_warp += team.size()) {
    const std::uint64_t k = of_warp + lane();
    const std::uint32_t own = k < patches ? f.colors[k] : kUncolored;
    std::uint32_t place = 0;
    each_color_of_warp(own, [&](std::uint32_t color, unsigned lanes) {
      const std::uint32_t at = f.color_begin[color] + place_in_warp(lanes, &f.color_cursor[color]);
      if (own == color) place = at;
    });
    if (own == kUncolored) continue;
    f.patch_at[place] = static_cast<std::uint32_t>(k);
    list_by_color(f, f.ranks[k].body_a, own, place, 0);
    list_by_color(f, f.ranks[k].body_b, own, place, 1);
  }
  for (std::uint64_t color = team.rank(); color < f.counts->colors; color += team.size())
    for (std::uint32_t place = f.color_begin[color] + f.color_count[color]; place < f.color_begin[color + 1]; ++place)
      f.patch_at[place] = kUncolored;
}

}  // namespace broadside::gpu
