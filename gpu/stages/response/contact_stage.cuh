// The collision response: METHOD sections 4 to 6.
#pragma once

#include "core/method/contact_geometry.hpp"
#include "core/method/response.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/contact_words.cuh"
#include "gpu/stages/response/order_stage.cuh"

namespace broadside::gpu {

// What a contact needs of a body and what does not change during a frame.
struct ContactSide {
  core::Box local_box;
  float inverse_mass = 0.0F;
};

// Geometry and response of one pair from these states. Returns false if the boxes no longer overlap; then the post
// states are the pre states.
__device__ inline bool fill_contact(const FrameView& f, core::Pair p, std::uint32_t color, const core::Material& both,
                                    const ContactSide& a, const ContactSide& b, const core::Kinematics& state_a,
                                    const core::Kinematics& state_b, core::Contact& contact) {
  contact.a = p.i;
  contact.b = p.j;
  contact.color = color;
  contact.depth_m = 0.0F;
  contact.pre_a = contact.post_a = state_a;
  contact.pre_b = contact.post_b = state_b;
  const core::ContactGeometry geometry = core::box_contact(
      core::translated(a.local_box, state_a.x), core::translated(b.local_box, state_b.x), f.parameters.epsilon_m);
  if (!geometry.exists) return false;
  core::respond(contact, geometry, a.inverse_mass, b.inverse_mass, both, f.parameters, f.variant);
  return true;
}

// Live bodies: threads read them while other threads write them. The two words of a body are enough for a reader to see
// whether they were written together, so waiting for a contact's turn costs one round trip to memory. Words: GridWords
// or BlockWords, depending on the memory in which the bodies lie.
template <typename Words>
struct LiveBodies {
  LiveBody* bodies;

  __device__ LiveBody fetch(std::uint32_t body) const {
    uint4 both[2];
    Words::load_two_whole(reinterpret_cast<const uint4*>(bodies + body), both);
    LiveBody out;
    memcpy(&out, both, sizeof out);
    return out;
  }
  // Whether what was fetched is the state after `rank` contacts; always true for a body that is never written.
  __device__ static bool is_at(const LiveBody& b, std::uint32_t rank) {
    return rank == kNoRank || (b.done == rank && ((b.tag ^ rank) & 1U) == 0);
  }
  __device__ void write(std::uint32_t body, const LiveBody& value) const {
    uint4 both[2];
    memcpy(both, &value, sizeof value);
    auto* words = reinterpret_cast<uint4*>(bodies + body);
    Words::store_whole(words, both[0]);
    Words::store_whole(words + 1, both[1]);
  }
};
using GridLive = LiveBodies<GridWords>;    // in global memory, seen by the whole grid
using BlockLive = LiveBodies<BlockWords>;  // in one block's shared memory

// A body after its contact of this rank and color.
__device__ inline LiveBody live_after(std::uint32_t rank, const core::Kinematics& s, std::uint32_t color) {
  return {s.x, rank + 1, s.v, (color + 1) << 1 | ((rank + 1) & 1U)};
}

template <typename Team, typename Live>
__device__ void start_live(const Team& team, const FrameView& f, const Live& live) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    live.write(static_cast<std::uint32_t>(i), {f.detected.position[i].v, 0, f.detected.velocity[i].v, 0});
  }
}

// One body's list of contacts in global memory.
class ListInMemory {
 public:
  __device__ ListInMemory(const FrameView& f, std::uint32_t body)
      : entries_(f.lists + f.list_begin[body]), degree_(f.degree[body]) {}

  __device__ std::uint32_t degree() const { return degree_; }
  __device__ ListEntry at(std::uint32_t rank) const { return entries_[rank]; }

 private:
  const ListEntry* entries_;
  std::uint32_t degree_;
};

__device__ inline ContactSide contact_side(const FrameView& f, std::uint32_t body) {
  return {local_box(f, body), f.previous.position[body].w};
}

// One body's way through its list. If both bodies of a contact are written, a hash of their ids chooses one of them:
// that body's thread resolves the contact once it is the next contact of both, and the other body's thread skips it.
template <typename Live, typename List>
class BodyTurn {
 public:
  __device__ BodyTurn(const FrameView& f, const Live& live, std::uint32_t body, const List& list,
                      const ContactSide& own_side)
      : f_(f), live_(live), body_(body), list_(list), own_side_(own_side) {}

  // Resolves all contacts that are this body's to resolve, each when its turn has come.
  __device__ void resolve_all() {
    seek(0);
    while (rank_ != list_.degree()) {
      if (try_resolve())
        seek(rank_ + 1);
      else
        relax();
    }
  }

 private:
  // Goes on to the next contact that this body resolves.
  __device__ void seek(std::uint32_t rank) {
    for (rank_ = rank; rank_ < list_.degree(); ++rank_) {
      entry_ = list_.at(rank_);
      if ((entry_.shape & ListEntry::kIsOurs) == 0) continue;
      other_side_ = {
          unpack(f_.shapes.octree[std::uint64_t{entry_.shape & ~ListEntry::kIsOurs} * core::kBodyOctreeNodes]),
          f_.previous.position[entry_.other].w};
      both_ = core::combine(f_.material[min(body_, entry_.other)], f_.material[max(body_, entry_.other)]);
      has_own_ = has_own_ && own_.done == rank_;
      return;
    }
  }

  // Resolves the contact if its turn has come. Once the body itself has come to this contact, no other thread writes
  // it, so it is not loaded again. Both bodies are loaded before either is tested. The other body is loaded again each
  // time, because there are no registers to keep it.
  __device__ bool try_resolve() {
    if (!has_own_) own_ = live_.fetch(body_);
    const LiveBody other = live_.fetch(entry_.other);
    has_own_ = has_own_ || live_.is_at(own_, rank_);
    if (!has_own_ || !live_.is_at(other, entry_.rank_other)) return false;
    const bool other_is_written = entry_.rank_other != kNoRank;
    const std::uint32_t color = max(own_.tag >> 1, other_is_written ? other.tag >> 1 : 0U);
    const bool is_a = body_ < entry_.other;
    core::Contact contact;
    fill_contact(f_, core::make_pair_of(body_, entry_.other), color, both_, chosen(is_a, own_side_, other_side_),
                 chosen(is_a, other_side_, own_side_), chosen(is_a, own_, other), chosen(is_a, other, own_), contact);
    own_ = live_after(rank_, chosen(is_a, contact.post_a, contact.post_b), color);
    live_.write(body_, own_);
    if (other_is_written)
      live_.write(entry_.other, live_after(entry_.rank_other, chosen(is_a, contact.post_b, contact.post_a), color));
    store_contact(f_.contacts + entry_.contact, contact);
    return true;
  }

  // Chooses word by word, because otherwise the compiler would put both objects into local memory.
  __device__ static core::Vec3 chosen(bool first, core::Vec3 p, core::Vec3 q) {
    return {first ? p.x : q.x, first ? p.y : q.y, first ? p.z : q.z};
  }
  __device__ static core::Kinematics chosen(bool first, const core::Kinematics& p, const core::Kinematics& q) {
    return {chosen(first, p.x, q.x), chosen(first, p.v, q.v)};
  }
  __device__ static core::Kinematics chosen(bool first, const LiveBody& p, const LiveBody& q) {
    return {chosen(first, p.x, q.x), chosen(first, p.v, q.v)};
  }
  __device__ static ContactSide chosen(bool first, const ContactSide& p, const ContactSide& q) {
    return {{chosen(first, p.local_box.min, q.local_box.min), chosen(first, p.local_box.max, q.local_box.max)},
            first ? p.inverse_mass : q.inverse_mass};
  }

  const FrameView& f_;
  const Live& live_;
  std::uint32_t body_;
  List list_;
  std::uint32_t rank_ = 0;
  ListEntry entry_;
  ContactSide own_side_;
  ContactSide other_side_;
  core::Material both_;
  LiveBody own_;
  bool has_own_ = false;
};

// Resolves all contacts in the order of their keys, without a barrier: a contact waits only for the earlier contacts of
// its own bodies. There must be at least as many threads as bodies, and each takes one body. Every thread of the team
// is resident, so the first contact that is left always has a thread that comes to it.
template <typename Team, typename Live>
__device__ void resolve_by_looking(const Team& team, const FrameView& f, const Live& live) {
  // If there are enough warps, bodies with neighboring ids go to different warps; otherwise to neighboring lanes, so
  // that their words lie side by side.
  const std::uint64_t body = std::uint64_t{f.body_count} * 2 <= team.size() ? team.lonely_rank() : team.spread_rank();
  if (body >= f.body_count) return;
  const auto own = static_cast<std::uint32_t>(body);
  BodyTurn(f, live, own, ListInMemory(f, own), contact_side(f, own)).resolve_all();
}

// Makes the states that contacts left the next states, and counts colors.
template <typename Team, typename Live>
__device__ void finish_live(const Team& team, const FrameView& f, const Live& live) {
  const std::uint64_t rounds = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t i = round * team.size() + team.rank();
    std::uint32_t colors = 0;
    if (i < f.body_count && f.degree[i] > 0) {
      const LiveBody last = live.fetch(static_cast<std::uint32_t>(i));
      f.next.position[i].v = last.x;
      f.next.velocity[i].v = last.v;
      colors = last.tag >> 1;
    }
    const std::uint32_t most = ~warp_min(~colors);
    if (lane() == 0 && most > 0) atomicMax(&f.counters->colors, most);
  }
  team.sync();
}

__device__ inline bool fill_from_next(const FrameView& f, const Link& link, core::Contact& contact) {
  return fill_contact(f, {link.i, link.j}, 0, core::combine(f.material[link.i], f.material[link.j]),
                      contact_side(f, link.i), contact_side(f, link.j),
                      {f.next.position[link.i].v, f.next.velocity[link.i].v},
                      {f.next.position[link.j].v, f.next.velocity[link.j].v}, contact);
}

// E8: all contacts at once. They overwrite each other's results, in the order in which the hardware happens to run
// them.
template <typename Team>
__device__ void resolve_racing(const Team& team, const FrameView& f, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const Link link = f.links[k];
    core::Contact contact;
    if (fill_from_next(f, link, contact)) {
      f.next.position[link.i].v = contact.post_a.x;
      f.next.velocity[link.i].v = contact.post_a.v;
      f.next.position[link.j].v = contact.post_b.x;
      f.next.velocity[link.j].v = contact.post_b.v;
    }
    store_contact(f.contacts + k, contact);
  }
  team.sync();
}

// Plain accumulation: every contact starts from the state before any response, and each body adds up its changes in the
// order of its pairs.
template <typename Team>
__device__ void resolve_jacobi(const Team& team, const FrameView& f, std::uint64_t count) {
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    core::Contact contact;
    fill_from_next(f, f.links[k], contact);
    store_contact(f.contacts + k, contact);
  }
  team.sync();
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    if (!is_written(f, static_cast<std::uint32_t>(i))) continue;
    core::Kinematics sum;
    for (std::uint32_t r = 0; r < f.degree[i]; ++r) {
      const core::Contact& c = f.contacts[f.lists[f.list_begin[i] + r].contact];
      if (!(c.depth_m > 0.0F)) continue;
      const core::Kinematics& pre = c.a == i ? c.pre_a : c.pre_b;
      const core::Kinematics& post = c.a == i ? c.post_a : c.post_b;
      sum.x = sum.x + (post.x - pre.x);
      sum.v = sum.v + (post.v - pre.v);
    }
    f.next.position[i].v = f.next.position[i].v + sum.x;
    f.next.velocity[i].v = f.next.velocity[i].v + sum.v;
  }
  team.sync();
}

}  // namespace broadside::gpu
