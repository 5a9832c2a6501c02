// Resolves contacts in the order of their keys if there are more bodies than threads. When a thread resolves the last
// contact that another contact waits for, it resolves that other contact next.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/contact_stage.cuh"

namespace broadside::gpu {

// Whether the contact of this rank is the body's first. The contacts of a body that is never written have no order.
__device__ inline bool is_first(std::uint32_t rank) {
  return rank == 0 || rank == kNoRank;
}

// Which contacts may be resolved. It lies in the memory of the keys, which are not needed once every contact has its
// ranks.
struct Turns {
  std::uint32_t* arrived;  // [contacts] how many of its bodies have come to it; 0 at the start
  std::uint32_t* queue;    // [contacts] the work queue: 1 + a contact whose turn has come; 0: not yet
  // How many places of the queue threads took, how many got a contact, and how many contacts are done. They lie in
  // different cache lines, because all warps write them.
  std::uint32_t* taken;
  std::uint32_t* given;
  std::uint32_t* done;

  __device__ explicit Turns(const FrameView& f)
      : arrived(reinterpret_cast<std::uint32_t*>(f.keys)),
        queue(arrived + f.confirmed.capacity),
        taken(queue + f.confirmed.capacity),
        given(taken + 64),
        done(given + 64) {}
};
static_assert(sizeof(FrameView::keys[0]) == 2 * sizeof(std::uint32_t) && kLeastPairs >= 192,
              "two keys a contact have room for all of this");

template <typename Team>
__device__ void start_turns(const Team& team, const Turns& turns, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) turns.arrived[k] = turns.queue[k] = 0;
  if (team.rank() == 0) *turns.taken = *turns.given = *turns.done = 0;
  team.sync();
}

// Puts the warp's contacts into the queue, which always has room, because a contact is queued at most once.
__device__ inline void queue_turns(const Turns& turns, bool has_one, std::uint32_t contact) {
  const unsigned pushing = __ballot_sync(kFullWarp, has_one);
  if (pushing == 0) return;
  std::uint32_t first = 0;
  if (lane() == 0) first = atomicAdd(turns.given, static_cast<std::uint32_t>(__popc(pushing)));
  first = __shfl_sync(kFullWarp, first, 0);
  if (has_one)
    *static_cast<volatile std::uint32_t*>(turns.queue + first + __popc(pushing & ((1U << lane()) - 1U))) = contact + 1;
}

// For a body whose contact of this rank is done: gets its next contact, if it has one. Returns whether that contact
// waited only for this body.
__device__ inline bool arrives(const FrameView& f, const Turns& turns, std::uint32_t body, std::uint32_t rank,
                               ListEntry& entry) {
  if (rank == kNoRank || rank + 1 == f.degree[body]) return false;
  entry = f.lists[f.list_begin[body] + rank + 1];
  return is_first(entry.rank_other) || atomicAdd(&turns.arrived[entry.contact], 1U) == 1;
}

// The contact that a body has come to, as a link with the lower body first.
__device__ inline Link link_of(std::uint32_t body, std::uint32_t rank, const ListEntry& entry) {
  return body < entry.other ? Link{body, entry.other, rank, entry.rank_other}
                            : Link{entry.other, body, entry.rank_other, rank};
}

template <typename Live>
__device__ void resolve_link(const FrameView& f, const Live& live, std::uint32_t place, const Link& link) {
  LiveBody a;
  LiveBody b;
  // Both states were written before the contact's turn came, but may become visible later.
  for (;;) {
    a = live.fetch(link.i);
    b = live.fetch(link.j);
    if (live.is_at(a, link.rank_i) && live.is_at(b, link.rank_j)) break;
    relax();
  }
  const std::uint32_t color = max(link.rank_i != kNoRank ? a.tag >> 1 : 0U, link.rank_j != kNoRank ? b.tag >> 1 : 0U);
  core::Contact contact;
  fill_contact(f, {link.i, link.j}, color, core::combine(f.material[link.i], f.material[link.j]),
               contact_side(f, link.i), contact_side(f, link.j), {a.x, a.v}, {b.x, b.v}, contact);
  if (link.rank_i != kNoRank) live.write(link.i, live_after(link.rank_i, contact.post_a, color));
  if (link.rank_j != kNoRank) live.write(link.j, live_after(link.rank_j, contact.post_b, color));
  store_contact(f.contacts + place, contact);
}

// Queues all contacts that wait for no other contact: threads begin with these.
template <typename Team>
__device__ void queue_first_turns(const Team& team, const FrameView& f, const Turns& turns, std::uint64_t count) {
  const std::uint64_t rounds = (count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * team.size() + team.rank();
    const bool is_ready = k < count && is_first(f.links[k].rank_i) && is_first(f.links[k].rank_j);
    queue_turns(turns, is_ready, static_cast<std::uint32_t>(k));
  }
}

// Links must have their final ranks. A lane without a contact takes a place in the queue and waits for that place to be
// filled, so that the lane that has waited longest gets the next contact.
template <typename Team, typename Live>
__device__ void resolve_by_arrival(const Team& team, const FrameView& f, std::uint64_t count, const Live& live) {
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  constexpr std::uint32_t kLooksBetween = 16;
  const Turns turns(f);
  start_turns(team, turns, count);
  queue_first_turns(team, f, turns, count);
  std::uint32_t place = kNone;  // in the queue
  std::uint32_t contact = 0;
  Link link;
  bool has_turn = false;
  std::uint32_t done = 0;  // contacts that the warp resolved and has not added to turns.done
  std::uint32_t idle = 0;
  for (;;) {
    const bool asks = !has_turn && place == kNone;
    if (const unsigned asking = __ballot_sync(kFullWarp, asks); asking != 0) {
      std::uint32_t first = 0;
      if (lane() == 0) first = atomicAdd(turns.taken, static_cast<std::uint32_t>(__popc(asking)));
      first = __shfl_sync(kFullWarp, first, 0);
      if (asks) place = first + __popc(asking & ((1U << lane()) - 1U));
    }
    if (!has_turn && place < count) {
      const std::uint32_t given = *static_cast<volatile std::uint32_t*>(turns.queue + place);
      if (given != 0) {
        contact = given - 1;
        link = f.links[contact];
        has_turn = true;
        place = kNone;
      }
    }
    const unsigned busy = __ballot_sync(kFullWarp, has_turn);
    if (busy == 0) {
      if (lane() == 0 && done != 0) atomicAdd(turns.done, done);
      done = 0;
      // Only every 16th time, because all warps load the same word. One lane decides, so that the warp stays together.
      if (++idle % kLooksBetween == 0) {
        const std::uint32_t by_all = *static_cast<volatile std::uint32_t*>(turns.done);
        if (__shfl_sync(kFullWarp, by_all, 0) == count) return;
      }
      relax();
      continue;
    }
    done += static_cast<std::uint32_t>(__popc(busy));
    bool comes_i = false;
    bool comes_j = false;
    ListEntry of_i;
    ListEntry of_j;
    if (has_turn) {
      resolve_link(f, live, contact, link);
      comes_i = arrives(f, turns, link.i, link.rank_i, of_i);
      comes_j = arrives(f, turns, link.j, link.rank_j, of_j);
      has_turn = comes_i || comes_j;
      if (comes_i) {
        contact = of_i.contact;
        link = link_of(link.i, link.rank_i + 1, of_i);
      } else if (comes_j) {
        contact = of_j.contact;
        link = link_of(link.j, link.rank_j + 1, of_j);
      }
    }
    queue_turns(turns, comes_i && comes_j, of_j.contact);
  }
}

}  // namespace broadside::gpu
