// Contacts of bodies: which pairs touch, their colors, and the response color by color. METHOD sections 4 to 6.
#pragma once

#include "core/method/coloring.hpp"
#include "core/method/contact_geometry.hpp"
#include "core/method/response.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kUncolored = 0xFFFFFFFEU;

template <typename Team>
__device__ void collect_touching(const Team& team, const FrameView& f, std::uint64_t confirmed) {
  const std::uint64_t rounds = (confirmed + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * team.size() + team.rank();
    const bool touches = k < confirmed && (!f.has_vertex_stage || f.proximity[k].is_touching());
    const unsigned long long place = warp_append(touches ? 1U : 0U, &f.counters->touching);
    if (!touches) continue;
    f.touching[place] = f.confirmed.items[k];
    f.color[place] = kUncolored;
  }
}

// Tells all threads of the team whether any of them has work left; one barrier. Rounds use the three flags in turn: the
// one of the next round is cleared while nobody looks at it.
template <typename Team>
__device__ bool is_any_left(const Team& team, const FrameView& f, std::uint32_t round, bool mine) {
  if (team.rank() == 0) f.counters->uncolored[(round + 1) % 3] = 0;
  if (__syncthreads_or(mine ? 1 : 0) != 0 && threadIdx.x == 0) f.counters->uncolored[round % 3] = 1;
  team.sync();
  return *static_cast<volatile std::uint32_t*>(&f.counters->uncolored[round % 3]) != 0;
}

// Lowers a body's word to this value, without an atomic where it is there already.
__device__ inline void announce(unsigned long long* least, unsigned long long value) {
  if (*static_cast<volatile unsigned long long*>(least) > value) atomicMin(least, value);
}

// The smallest color that is free at both bodies, in words of 64 colors; color_words * 64 when there is none.
__device__ inline std::uint32_t smallest_free_color(const FrameView& f, const unsigned long long* taken_a,
                                                    const unsigned long long* taken_b) {
  for (std::uint32_t word = 0; word < f.color_words; ++word) {
    const unsigned long long taken =
        (taken_a != nullptr ? taken_a[word] : 0ULL) | (taken_b != nullptr ? taken_b[word] : 0ULL);
    if (taken != ~0ULL) return word * 64 + static_cast<std::uint32_t>(__ffsll(static_cast<long long>(~taken))) - 1;
  }
  return f.color_words * 64;
}

// Colors contact k: the smallest color free at its dynamic bodies. Only one thread at a time comes here for a body.
__device__ inline void take_color(const FrameView& f, std::uint64_t k, unsigned long long* taken_a,
                                  unsigned long long* taken_b) {
  const std::uint32_t color = smallest_free_color(f, taken_a, taken_b);
  if (color == f.color_words * 64) {
    atomicMax(&f.counters->words_demanded, f.color_words + 1);
  } else {
    const unsigned long long bit = 1ULL << (color % 64);
    if (taken_a != nullptr) taken_a[color / 64] |= bit;
    if (taken_b != nullptr) taken_b[color / 64] |= bit;
    if (*static_cast<volatile std::uint32_t*>(&f.counters->colors) < color + 1)
      atomicMax(&f.counters->colors, color + 1);
  }
  f.color[k] = color;
}

// The sequential greedy coloring in the order of core::color_priority, by rounds: a contact whose priority is the least
// among those without color at each of its dynamic bodies has only colored contacts before it, so it may take its
// color. Too few words of colors end up in words_demanded.
//
// One barrier a round: contacts read the words of this round, announce themselves for the next, and clear those of the
// round after it, which were last read a round ago.
template <typename Team>
__device__ void color_contacts(const Team& team, const FrameView& f, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const core::Pair p = f.touching[k];
    const unsigned long long priority = core::color_priority(p);
    announce(&f.least_priority[p.i], priority);
    announce(&f.least_priority[p.j], priority);
  }
  team.sync();
  for (std::uint32_t round = 0;; ++round) {
    unsigned long long* now = f.least_priority + std::uint64_t{round % 3} * f.body_count;
    unsigned long long* next = f.least_priority + std::uint64_t{(round + 1) % 3} * f.body_count;
    unsigned long long* later = f.least_priority + std::uint64_t{(round + 2) % 3} * f.body_count;
    bool has_left = false;
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      if (f.color[k] != kUncolored) continue;
      const core::Pair p = f.touching[k];
      const unsigned long long priority = core::color_priority(p);
      const bool moves_a = !is_static(f, p.i);
      const bool moves_b = !is_static(f, p.j);
      later[p.i] = later[p.j] = ~0ULL;
      if ((!moves_a || now[p.i] == priority) && (!moves_b || now[p.j] == priority)) {
        take_color(f, k, moves_a ? f.taken + std::uint64_t{p.i} * f.color_words : nullptr,
                   moves_b ? f.taken + std::uint64_t{p.j} * f.color_words : nullptr);
        continue;
      }
      has_left = true;
      announce(&next[p.i], priority);
      announce(&next[p.j], priority);
    }
    if (!is_any_left(team, f, round, has_left)) return;
  }
}

// The same by one block, with the bodies' words in shared memory; colors must fit one word.
__device__ inline void color_contacts_in_block(const FrameView& f, std::uint64_t count, unsigned long long* words) {
  unsigned long long* least = words;
  unsigned long long* taken = words + f.body_count;
  for (std::uint32_t i = threadIdx.x; i < f.body_count; i += blockDim.x) least[i] = ~0ULL, taken[i] = 0;
  __syncthreads();
  for (;;) {
    for (std::uint64_t k = threadIdx.x; k < count; k += blockDim.x) {
      if (f.color[k] != kUncolored) continue;
      const core::Pair p = f.touching[k];
      announce(&least[p.i], core::color_priority(p));
      announce(&least[p.j], core::color_priority(p));
    }
    __syncthreads();
    bool has_left = false;
    for (std::uint64_t k = threadIdx.x; k < count; k += blockDim.x) {
      if (f.color[k] != kUncolored) continue;
      const core::Pair p = f.touching[k];
      const unsigned long long priority = core::color_priority(p);
      const bool moves_a = !is_static(f, p.i);
      const bool moves_b = !is_static(f, p.j);
      // A body's word is read by all its contacts and cleared by the one whose priority it holds: whichever of the two
      // values the others see, it is not theirs.
      const auto is_least = [&](std::uint32_t body) {
        return *static_cast<volatile unsigned long long*>(&least[body]) == priority;
      };
      if ((moves_a && !is_least(p.i)) || (moves_b && !is_least(p.j))) {
        has_left = true;
        continue;
      }
      take_color(f, k, moves_a ? &taken[p.i] : nullptr, moves_b ? &taken[p.j] : nullptr);
      if (moves_a) least[p.i] = ~0ULL;
      if (moves_b) least[p.j] = ~0ULL;
    }
    if (__syncthreads_or(has_left ? 1 : 0) == 0) return;
  }
}

// Geometry and response of one pair from the states in `next`. Returns false when the boxes do not overlap any more.
__device__ inline bool fill_contact(const FrameView& f, core::Pair p, std::uint32_t color, core::Contact& contact) {
  const PackedVec3 xa = f.next.position[p.i];
  const PackedVec3 xb = f.next.position[p.j];
  contact.a = p.i;
  contact.b = p.j;
  contact.color = color;
  contact.depth_m = 0.0F;
  const core::ContactGeometry geometry = core::box_contact(
      core::translated(local_box(f, p.i), xa.v), core::translated(local_box(f, p.j), xb.v), f.parameters.epsilon_m);
  if (!geometry.exists) return false;
  contact.pre_a = {xa.v, f.next.velocity[p.i].v};
  contact.pre_b = {xb.v, f.next.velocity[p.j].v};
  core::respond(contact, geometry, xa.w, xb.w, core::combine(f.material[p.i], f.material[p.j]), f.parameters,
                f.variant);
  return true;
}

__device__ inline void store_state(const FrameView& f, std::uint32_t body, const core::Kinematics& s) {
  f.next.position[body].v = s.x;
  f.next.velocity[body].v = s.v;
}

// One color after another; contacts of one color share no dynamic body.
template <typename Team>
__device__ void resolve_colors(const Team& team, const FrameView& f, std::uint64_t count) {
  const std::uint32_t colors = f.counters->colors;
  for (std::uint32_t color = 0; color < colors; ++color) {
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      if (f.color[k] != color) continue;
      const core::Pair p = f.touching[k];
      core::Contact contact;
      if (fill_contact(f, p, color, contact)) {
        // Printed form E3 moves static bodies, which is the point of it.
        if (!is_static(f, p.i) || f.variant == core::Variant::kE3) store_state(f, p.i, contact.post_a);
        if (!is_static(f, p.j) || f.variant == core::Variant::kE3) store_state(f, p.j, contact.post_b);
      }
      f.contacts[k] = contact;
    }
    team.sync();
  }
}

// E8: every contact at once, one's write over the other's, in whatever order the hardware comes to them.
template <typename Team>
__device__ void resolve_racing(const Team& team, const FrameView& f, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const core::Pair p = f.touching[k];
    core::Contact contact;
    if (fill_contact(f, p, 0, contact)) {
      store_state(f, p.i, contact.post_a);
      store_state(f, p.j, contact.post_b);
    }
    f.contacts[k] = contact;
  }
  team.sync();
}

// Plain accumulation: every contact sees the state before any response. Each body's changes are added in the order of
// its pairs, by rounds: the contact with the least key left at a body adds to that body.
template <typename Team>
__device__ void resolve_jacobi(const Team& team, const FrameView& f, std::uint64_t count) {
  constexpr std::uint32_t kDoneA = 1;
  constexpr std::uint32_t kDoneB = 2;
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    core::Contact contact;
    fill_contact(f, f.touching[k], 0, contact);
    f.contacts[k] = contact;
    f.color[k] = contact.depth_m > 0.0F ? 0 : kDoneA | kDoneB;
  }
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) f.sums[i] = core::Kinematics{};
  team.sync();
  const auto add = [&f](std::uint32_t body, const core::Kinematics& pre, const core::Kinematics& post) {
    core::Kinematics& sum = f.sums[body];
    sum.x = sum.x + (post.x - pre.x);
    sum.v = sum.v + (post.v - pre.v);
    f.least_priority[body] = ~0ULL;
  };
  for (std::uint32_t round = 0;; ++round) {
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      const core::Pair p = f.touching[k];
      if ((f.color[k] & kDoneA) == 0) atomicMin(&f.least_priority[p.i], core::pair_key(p));
      if ((f.color[k] & kDoneB) == 0) atomicMin(&f.least_priority[p.j], core::pair_key(p));
    }
    team.sync();
    bool has_left = false;
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      const core::Pair p = f.touching[k];
      const core::Contact& c = f.contacts[k];
      const std::uint64_t key = core::pair_key(p);
      const auto is_next = [&](std::uint32_t body) {
        return *static_cast<volatile unsigned long long*>(&f.least_priority[body]) == key;
      };
      std::uint32_t done = f.color[k];
      if ((done & kDoneA) == 0 && is_next(p.i)) add(p.i, c.pre_a, c.post_a), done |= kDoneA;
      if ((done & kDoneB) == 0 && is_next(p.j)) add(p.j, c.pre_b, c.post_b), done |= kDoneB;
      f.color[k] = done;
      has_left = has_left || done != (kDoneA | kDoneB);
    }
    if (!is_any_left(team, f, round, has_left)) break;
  }
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    const core::Kinematics sum = f.sums[i];
    f.next.position[i].v = f.next.position[i].v + sum.x;
    f.next.velocity[i].v = f.next.velocity[i].v + sum.v;
  }
  team.sync();
}

}  // namespace broadside::gpu
