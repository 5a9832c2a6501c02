// Contacts of bodies: which pairs touch, their colors, and the response color by color. METHOD sections 4 to 6.
#pragma once

#include "core/method/coloring.hpp"
#include "core/method/contact_geometry.hpp"
#include "core/method/response.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// A contact without color, plus 1 when its body a is static and 2 when its body b is.
constexpr std::uint32_t kUncolored = 0xFFFFFFFCU;
constexpr std::uint32_t kStaticA = 1;
constexpr std::uint32_t kStaticB = 2;

template <typename Team>
__device__ void collect_touching(const Team& team, const FrameView& f, std::uint64_t confirmed) {
  const std::uint64_t rounds = (confirmed + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * team.size() + team.rank();
    const bool touches = k < confirmed && (!f.has_vertex_stage || f.proximity[k].is_touching());
    const unsigned long long place = warp_append(touches ? 1U : 0U, &f.counters->touching);
    if (!touches) continue;
    const core::Pair p = f.confirmed.items[k];
    f.touching[place] = p;
    f.color[place] = kUncolored + (is_static(f, p.i) ? kStaticA : 0U) + (is_static(f, p.j) ? kStaticB : 0U);
  }
}

// Tells all threads of the team whether any of them has work left; one barrier. Rounds use the three flags in turn: the
// one of the next round is cleared while nobody looks at it.
template <typename Team>
__device__ bool is_any_left(const Team& team, const FrameView& f, std::uint32_t round, bool mine) {
  if (team.rank() == 0) f.counters->is_left[(round + 1) % 3] = 0;
  if (__syncthreads_or(mine ? 1 : 0) != 0 && threadIdx.x == 0) f.counters->is_left[round % 3] = 1;
  team.sync();
  return *static_cast<volatile std::uint32_t*>(&f.counters->is_left[round % 3]) != 0;
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

// A contact on its way to a color.
struct OpenContact {
  core::Pair pair;
  unsigned long long priority;
  bool moves_a;
  bool moves_b;
};

__device__ inline OpenContact open_contact(const FrameView& f, std::uint64_t k) {
  const core::Pair p = f.touching[k];
  const std::uint32_t marks = f.color[k] - kUncolored;
  return {p, core::color_priority(p), (marks & kStaticA) == 0, (marks & kStaticB) == 0};
}

// Colors contact k: the smallest color free at its dynamic bodies, and the next place among the contacts of that color
// (whichever thread comes first: contacts of one color are independent). Only one thread at a time comes for a body.
__device__ inline void take_color(const FrameView& f, std::uint64_t k, const OpenContact& c, unsigned long long* taken,
                                  std::uint32_t words) {
  unsigned long long* taken_a = c.moves_a ? taken + std::uint64_t{c.pair.i} * words : nullptr;
  unsigned long long* taken_b = c.moves_b ? taken + std::uint64_t{c.pair.j} * words : nullptr;
  const std::uint32_t color = smallest_free_color(f, taken_a, taken_b);
  f.color[k] = color;
  if (color == words * 64) {
    atomicMax(&f.counters->words_demanded, words + 1);
    return;
  }
  const unsigned long long bit = 1ULL << (color % 64);
  if (taken_a != nullptr) taken_a[color / 64] |= bit;
  if (taken_b != nullptr) taken_b[color / 64] |= bit;
  f.color_rank[k] = atomicAdd(&f.color_count[color], 1U);
}

// The sequential greedy coloring in the order of core::color_priority, by rounds: a contact whose priority is the least
// among those without color at each of its dynamic bodies has only colored contacts before it, so it may take its
// color. Too few words of colors end up in words_demanded.
//
// One barrier a round: contacts read the words of this round, announce themselves for the next, and clear those of the
// round after it, which were last read a round ago. Contacts that stay open move to the other of two lists, so that
// warps stay full; the three lengths are used in turn in the same way.
template <typename Team>
__device__ void color_contacts(const Team& team, const FrameView& f, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const OpenContact c = open_contact(f, k);
    if (c.moves_a) announce(&f.least_priority[c.pair.i], c.priority);
    if (c.moves_b) announce(&f.least_priority[c.pair.j], c.priority);
  }
  team.sync();
  std::uint64_t open = count;
  for (std::uint32_t round = 0; open > 0; ++round) {
    const unsigned long long* now = f.least_priority + std::uint64_t{round % 3} * f.body_count;
    unsigned long long* next = f.least_priority + std::uint64_t{(round + 1) % 3} * f.body_count;
    unsigned long long* later = f.least_priority + std::uint64_t{(round + 2) % 3} * f.body_count;
    const std::uint32_t* list = f.open_contacts[round % 2];
    std::uint32_t* next_list = f.open_contacts[(round + 1) % 2];
    if (team.rank() == 0) f.counters->open[(round + 2) % 3] = 0;
    const std::uint64_t turns = (open + team.size() - 1) / team.size();
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
      const std::uint64_t place = turn * team.size() + team.rank();
      std::uint32_t k = 0;
      bool stays = false;
      if (place < open) {
        k = round == 0 ? static_cast<std::uint32_t>(place) : list[place];
        const OpenContact c = open_contact(f, k);
        if (c.moves_a) later[c.pair.i] = ~0ULL;
        if (c.moves_b) later[c.pair.j] = ~0ULL;
        stays = (c.moves_a && now[c.pair.i] != c.priority) || (c.moves_b && now[c.pair.j] != c.priority);
        if (stays) {
          if (c.moves_a) announce(&next[c.pair.i], c.priority);
          if (c.moves_b) announce(&next[c.pair.j], c.priority);
        } else {
          take_color(f, k, c, f.taken, f.color_words);
        }
      }
      const unsigned long long next_place = warp_append(stays ? 1U : 0U, &f.counters->open[(round + 1) % 3]);
      if (stays) next_list[next_place] = k;
    }
    team.sync();
    open = *static_cast<volatile unsigned long long*>(&f.counters->open[(round + 1) % 3]);
  }
}

// The same by one block, with the bodies' words in shared memory; at most 64 contacts a thread, 64 colors.
__device__ inline void color_contacts_in_block(const FrameView& f, std::uint64_t count, unsigned long long* words) {
  unsigned long long* least = words;
  unsigned long long* taken = words + f.body_count;
  for (std::uint32_t i = threadIdx.x; i < f.body_count; i += blockDim.x) least[i] = ~0ULL, taken[i] = 0;
  std::uint64_t open = 0;  // bit s: contact threadIdx.x + s blockDim.x
  for (std::uint64_t k = threadIdx.x, bit = 1; k < count; k += blockDim.x, bit <<= 1) open |= bit;
  const auto contact_of = [](std::uint64_t bits) {
    return threadIdx.x + static_cast<std::uint64_t>(__ffsll(static_cast<long long>(bits)) - 1) * blockDim.x;
  };
  while (__syncthreads_or(open != 0 ? 1 : 0) != 0) {
    for (std::uint64_t bits = open; bits != 0; bits &= bits - 1) {
      const OpenContact c = open_contact(f, contact_of(bits));
      if (c.moves_a) atomicMin(&least[c.pair.i], c.priority);
      if (c.moves_b) atomicMin(&least[c.pair.j], c.priority);
    }
    __syncthreads();
    std::uint64_t firsts = 0;
    for (std::uint64_t bits = open; bits != 0; bits &= bits - 1) {
      const OpenContact c = open_contact(f, contact_of(bits));
      if ((!c.moves_a || least[c.pair.i] == c.priority) && (!c.moves_b || least[c.pair.j] == c.priority))
        firsts |= bits & -bits;
    }
    __syncthreads();
    for (std::uint64_t bits = firsts; bits != 0; bits &= bits - 1) {
      const std::uint64_t k = contact_of(bits);
      const OpenContact c = open_contact(f, k);
      take_color(f, k, c, taken, 1);
      if (c.moves_a) least[c.pair.i] = ~0ULL;
      if (c.moves_b) least[c.pair.j] = ~0ULL;
    }
    open &= ~firsts;
  }
}

// Lists the contacts by color: those of color c are open_contacts[0][color_begin[c] .. color_begin[c + 1]).
template <typename Team>
__device__ void order_by_color(const Team& team, const FrameView& f, std::uint64_t count) {
  const std::uint32_t most = f.color_words * 64;
  if (team.rank() < 32) {
    std::uint32_t before = 0;
    for (std::uint32_t first = 0; first < most; first += 32) {
      const std::uint32_t mine = f.color_count[first + lane()];
      std::uint32_t sum = mine;
      for (unsigned step = 1; step < 32; step *= 2) {
        const std::uint32_t other = __shfl_up_sync(kFullWarp, sum, step);
        if (lane() >= step) sum += other;
      }
      f.color_begin[first + lane()] = before + sum - mine;
      const unsigned used = __ballot_sync(kFullWarp, mine != 0);
      if (lane() == 0 && used != 0) f.counters->colors = first + 32 - static_cast<std::uint32_t>(__clz(used));
      before += __shfl_sync(kFullWarp, sum, 31);
    }
    if (lane() == 0) f.color_begin[most] = before;
  }
  team.sync();
  for (std::uint64_t k = team.rank(); k < count; k += team.size())
    f.open_contacts[0][f.color_begin[f.color[k]] + f.color_rank[k]] = static_cast<std::uint32_t>(k);
  team.sync();
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
__device__ void resolve_colors(const Team& team, const FrameView& f) {
  const std::uint32_t colors = f.counters->colors;
  for (std::uint32_t color = 0; color < colors; ++color) {
    const std::uint64_t end = f.color_begin[color + 1];
    for (std::uint64_t place = f.color_begin[color] + team.rank(); place < end; place += team.size()) {
      const std::uint32_t k = f.open_contacts[0][place];
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
