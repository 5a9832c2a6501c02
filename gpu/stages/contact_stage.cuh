// Contacts of bodies: which pairs touch, their colors, and the response color by color. METHOD sections 4 to 6.
#pragma once

#include "core/method/coloring.hpp"
#include "core/method/contact_geometry.hpp"
#include "core/method/response.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kNoContact = 0xFFFFFFFFU;

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
    if (f.solver != Solver::kColored) continue;
    // Its place in the list of each moving body: whatever the order of the threads makes it, the lists are sorted.
    std::uint32_t* slots = f.list_slots + 2 * place;
    slots[0] = is_static(f, p.i) ? kNoContact : atomicAdd(&f.degree[p.i], 1U);
    slots[1] = is_static(f, p.j) ? kNoContact : atomicAdd(&f.degree[p.j], 1U);
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

// Sorts one body's contacts by priority, in place. A heap sort: a giant may have thousands of them.
__device__ inline void sort_by_priority(const FrameView& f, std::uint32_t* list, std::uint32_t count) {
  const auto priority = [&f](std::uint32_t k) { return core::color_priority(f.touching[k]); };
  const auto sink = [&](std::uint32_t root, std::uint32_t end) {
    const std::uint32_t item = list[root];
    const unsigned long long key = priority(item);
    for (std::uint32_t child = 2 * root + 1; child < end; child = 2 * root + 1) {
      unsigned long long child_key = priority(list[child]);
      if (child + 1 < end) {
        const unsigned long long other_key = priority(list[child + 1]);
        if (other_key > child_key) ++child, child_key = other_key;
      }
      if (child_key <= key) break;
      list[root] = list[child];
      root = child;
    }
    list[root] = item;
  };
  for (std::uint32_t root = count / 2; root > 0; --root) sink(root - 1, count);
  for (std::uint32_t end = count; end > 1; --end) {
    const std::uint32_t last = list[end - 1];
    list[end - 1] = list[0];
    list[0] = last;
    sink(0, end - 1);
  }
}

// Each moving body's list of its contacts in the order of their priority.
template <typename Team>
__device__ void list_contacts(const Team& team, const FrameView& f, std::uint64_t count) {
  const std::uint64_t turns = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t turn = 0; turn < turns; ++turn) {
    const std::uint64_t i = turn * team.size() + team.rank();
    const auto begin =
        static_cast<std::uint32_t>(warp_append(i < f.body_count ? f.degree[i] : 0U, &f.counters->listed));
    if (i < f.body_count) f.list_begin[i] = begin;
  }
  team.sync();
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const core::Pair p = f.touching[k];
    const std::uint32_t* slots = f.list_slots + 2 * k;
    if (slots[0] != kNoContact) f.lists[f.list_begin[p.i] + slots[0]] = static_cast<std::uint32_t>(k);
    if (slots[1] != kNoContact) f.lists[f.list_begin[p.j] + slots[1]] = static_cast<std::uint32_t>(k);
  }
  team.sync();
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    const std::uint32_t degree = f.degree[i];
    std::uint32_t* list = f.lists + f.list_begin[i];
    sort_by_priority(f, list, degree);
    f.front[i] = f.front[f.body_count + i] = degree > 0 ? list[0] : kNoContact;
    f.listed[i] = 0;
    f.unpublished[i] = kNoContact;
  }
  team.sync();
}

// The sequential greedy coloring in the order of core::color_priority, by rounds. A contact that is the first left in
// the lists of both its bodies has only colored contacts before it, so it takes the smallest color free at both. Both
// bodies' threads come to the same color from the same words, and each writes its own body alone: no atomics, one
// barrier a round. Words are double, read from one copy and written to the other; a bit that was set in one is set in
// the other a round later. Too few words of colors end up in words_demanded.
template <typename Team>
__device__ void color_contacts(const Team& team, const FrameView& f) {
  const std::uint64_t words = std::uint64_t{f.body_count} * f.color_words;
  for (std::uint32_t round = 0;; ++round) {
    const std::uint32_t* front = f.front + std::uint64_t{round % 2} * f.body_count;
    std::uint32_t* next_front = f.front + std::uint64_t{(round + 1) % 2} * f.body_count;
    const unsigned long long* taken = f.taken + (round % 2) * words;
    unsigned long long* next_taken = f.taken + ((round + 1) % 2) * words;
    bool has_left = false;
    for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
      if (f.unpublished[i] != kNoContact) {
        const std::uint32_t color = f.unpublished[i];
        next_taken[i * f.color_words + color / 64] |= 1ULL << (color % 64);
        f.unpublished[i] = kNoContact;
      }
      const std::uint32_t k = front[i];
      next_front[i] = k;
      if (k == kNoContact) continue;
      has_left = true;
      const core::Pair p = f.touching[k];
      const bool is_a = p.i == i;
      const std::uint32_t other = is_a ? p.j : p.i;
      const bool other_moves = f.list_slots[2 * std::uint64_t{k} + (is_a ? 1 : 0)] != kNoContact;
      if (other_moves && front[other] != k) continue;
      const std::uint32_t color = smallest_free_color(
          f, taken + i * f.color_words, other_moves ? taken + std::uint64_t{other} * f.color_words : nullptr);
      if (color == f.color_words * 64) {
        atomicMax(&f.counters->words_demanded, f.color_words + 1);
      } else {
        next_taken[i * f.color_words + color / 64] |= 1ULL << (color % 64);
        f.unpublished[i] = color;
        if (is_a || !other_moves) {
          f.color[k] = color;
          f.color_rank[k] = atomicAdd(&f.color_count[color], 1U);
        }
      }
      const std::uint32_t done = ++f.listed[i];
      next_front[i] = done < f.degree[i] ? f.lists[f.list_begin[i] + done] : kNoContact;
    }
    if (!is_any_left(team, f, round, has_left)) return;
  }
}

// Lists the contacts by color: those of color c are by_color[color_begin[c] .. color_begin[c + 1]).
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
    f.by_color[f.color_begin[f.color[k]] + f.color_rank[k]] = static_cast<std::uint32_t>(k);
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

// 144 bytes in nine wide stores: with one store a float, a block's stores are what a color waits for.
__device__ inline void store_contact(const FrameView& f, std::uint64_t k, const core::Contact& contact) {
  uint4 words[sizeof(core::Contact) / sizeof(uint4)];
  memcpy(words, &contact, sizeof contact);
  auto* to = reinterpret_cast<uint4*>(f.contacts + k);
#pragma unroll
  for (std::size_t w = 0; w < sizeof(core::Contact) / sizeof(uint4); ++w) to[w] = words[w];
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
    for (std::uint64_t place = f.color_begin[color] + team.spread_rank(); place < end; place += team.size()) {
      const std::uint32_t k = f.by_color[place];
      const core::Pair p = f.touching[k];
      core::Contact contact;
      if (fill_contact(f, p, color, contact)) {
        // Printed form E3 moves static bodies, which is the point of it.
        if (!is_static(f, p.i) || f.variant == core::Variant::kE3) store_state(f, p.i, contact.post_a);
        if (!is_static(f, p.j) || f.variant == core::Variant::kE3) store_state(f, p.j, contact.post_b);
      }
      store_contact(f, k, contact);
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
    store_contact(f, k, contact);
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
    store_contact(f, k, contact);
    f.color[k] = contact.depth_m > 0.0F ? 0 : kDoneA | kDoneB;
  }
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) f.sums[i] = core::Kinematics{};
  team.sync();
  const auto add = [&f](std::uint32_t body, const core::Kinematics& pre, const core::Kinematics& post) {
    core::Kinematics& sum = f.sums[body];
    sum.x = sum.x + (post.x - pre.x);
    sum.v = sum.v + (post.v - pre.v);
    f.least_key[body] = ~0ULL;
  };
  for (std::uint32_t round = 0;; ++round) {
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      const core::Pair p = f.touching[k];
      if ((f.color[k] & kDoneA) == 0) atomicMin(&f.least_key[p.i], core::pair_key(p));
      if ((f.color[k] & kDoneB) == 0) atomicMin(&f.least_key[p.j], core::pair_key(p));
    }
    team.sync();
    bool has_left = false;
    for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
      const core::Pair p = f.touching[k];
      const core::Contact& c = f.contacts[k];
      const std::uint64_t key = core::pair_key(p);
      const auto is_next = [&](std::uint32_t body) {
        return *static_cast<volatile unsigned long long*>(&f.least_key[body]) == key;
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
