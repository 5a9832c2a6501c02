// Makes kept pairs, and tests them in frames that need no search, by kernels without barriers.
#pragma once

#include "gpu/broad/kept_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/pack.cuh"

namespace broadside::gpu {

// How much fatter a box is made on each side, as a share of its mean side. Boxes that move by a hundredth of that side
// a frame stay within for six frames, and there are some (1 + 1/8)^3 = 1.4 times as many candidates as pairs.
constexpr float kFat = 0x1p-4F;

__device__ inline void run_fatten(const KeptView& view) {
  const GridPlaces grid;
  BoxMeasure own;
  for (std::uint64_t i = grid.rank(); i < view.count; i += grid.size()) {
    const PackedBox now = view.now[i];
    const core::Vec3 sides = now.max - now.min;
    const float fat_m = kFat / 3.0F * ((sides.x + sides.y) + sides.z);
    const core::Vec3 by{fat_m, fat_m, fat_m};
    const core::Box fat{now.min - by, now.max + by};
    note_box(fat, static_cast<std::uint32_t>(i), own);
    view.fat[i] = pack(fat, now.low_tag, now.high_tag);
  }
  add_measure(own, *view.measure);
}

__device__ inline void run_place(const KeptView& view) {
  const GridPlaces grid;
  for (std::uint64_t k = grid.rank(); k < view.count; k += grid.size()) {
    const std::uint32_t number = view.order[k].body;
    view.placed[k] = view.now[number];
    view.place_of[number] = static_cast<std::uint32_t>(k);
  }
}

__device__ inline void run_renumber(const KeptView& view) {
  const GridPlaces grid;
  for (std::uint64_t k = grid.rank(); k < view.candidate_count; k += grid.size()) {
    const core::Pair p = view.candidates[k];
    view.candidates[k] = {view.place_of[p.i], view.place_of[p.j]};
  }
}

// False also for what is not a box: then the boxes are packed, which refuses it.
__device__ inline bool is_within(const core::Box& b, const PackedBox& fat) {
  bool is_within_all = true;
  for (int k = 0; k < 3; ++k)
    is_within_all = is_within_all && fat.min[k] <= b.min[k] && b.min[k] <= b.max[k] && b.max[k] <= fat.max[k];
  return is_within_all;
}

// Boxes are read in the order of their numbers and written to their places; each fills a whole sector of memory.
__device__ inline void run_within(const KeptView& view) {
  const GridPlaces grid;
  bool has_left = false;
  for (std::uint64_t i = grid.rank(); i < view.count; i += grid.size()) {
    const core::Box box = view.given != nullptr ? given_box(view.given, i) : unpack(view.now[i]);
    view.placed[view.place_of[i]] = pack(box, static_cast<std::uint32_t>(i), 0U);
    has_left = has_left || !is_within(box, view.fat[i]);
  }
  if (__any_sync(kFullWarp, has_left) && lane() == 0) view.counts->left = 1;
}

// `shared`: a PairQueue for each warp.
__device__ inline void run_test(const KeptView& view, unsigned char* shared) {
  const GridPlaces grid;
  WarpQueue queue(reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32], view.pairs, &view.counts->pairs);
  const std::uint64_t rounds = (view.candidate_count + grid.size() - 1) / grid.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * grid.size() + grid.rank();
    bool is_pair = false;
    core::Pair pair{};
    if (k < view.candidate_count) {
      const core::Pair p = view.candidates[k];
      const PackedBox a = view.placed[p.i];
      const PackedBox b = view.placed[p.j];
      is_pair = core::overlaps(unpack(a), unpack(b));
      pair = core::make_pair_of(a.low_tag, b.low_tag);
    }
    queue.push(is_pair, pair);
  }
  queue.flush();
}

}  // namespace broadside::gpu
