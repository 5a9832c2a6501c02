// Response and faces of few contacts, by one block alone: METHOD sections 3 to 6. All that its threads share is in
// shared memory, where an atomic takes a tenth of the time that it takes in the L2 cache.
#pragma once

#include "core/method/coloring.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/block_room.cuh"
#include "gpu/stages/response/contact_stage.cuh"
#include "gpu/stages/response/order_stage.cuh"
#include "gpu/stages/vertices/narrow_pairs.cuh"

namespace broadside::gpu {

// One body's list of contacts in the block's shared memory.
class ListInBlock {
 public:
  __device__ ListInBlock(const FrameView& f, const BlockEntry* entries, std::uint32_t degree)
      : f_(f), entries_(entries), degree_(degree) {}

  __device__ std::uint32_t degree() const { return degree_; }
  __device__ ListEntry at(std::uint32_t rank) const { return entries_[rank].unpacked(f_); }

 private:
  const FrameView& f_;
  const BlockEntry* entries_;
  std::uint32_t degree_;
};

// Makes links of the touching pairs, as order_stage.cuh does. `narrow`: the thread's first pair.
__device__ inline void collect_in_block(const FrameView& f, NarrowPair narrow, const NarrowPairs& pairs,
                                        const BlockRoom& room) {
  for (std::uint64_t base = 0; base < pairs.count; base += blockDim.x) {
    if (base > 0) narrow = NarrowPair(f, pairs, base + threadIdx.x);
    const bool touches = narrow.touches(f);
    const std::uint32_t place = warp_append_one(touches, &room.counts->touching);
    if (!touches) continue;
    const core::Pair p = narrow.pair();
    room.keys[place] = core::color_priority(p);
    room.links[place] = BlockLink(p, BlockDegree::count(&room.degree[p.i]), BlockDegree::count(&room.degree[p.j]));
  }
}

// Makes each body's list, with two threads for each contact, one for each of its bodies.
__device__ inline void list_in_block(const FrameView& f, std::uint32_t count, const BlockRoom& room) {
  const bool is_body = threadIdx.x < f.body_count;
  const std::uint32_t begin =
      warp_append(is_body ? BlockDegree::of(room.degree[threadIdx.x]) : 0U, &room.counts->listed);
  if (is_body) room.list_begin[threadIdx.x] = begin;
  __syncthreads();
  const bool is_i = threadIdx.x % 2 == 0;
  for (std::uint32_t t = threadIdx.x; t < 2 * count; t += blockDim.x) {
    const BlockLink::Side own = room.links[t / 2].side(is_i);
    if (own.place != BlockLink::kNone)
      room.places[room.list_begin[own.body] + own.place] = static_cast<std::uint16_t>(t / 2);
  }
  __syncthreads();
  for (std::uint32_t base = 0; base < 2 * count; base += blockDim.x) {
    const std::uint32_t t = base + threadIdx.x;
    const bool exists = t < 2 * count;
    const std::uint32_t contact = exists ? t / 2 : 0;
    const BlockLink link = room.links[contact];
    const BlockLink::Side own = link.side(is_i);
    const std::uint32_t own_begin = room.list_begin[own.body];
    std::uint32_t rank = kNoRank;
    if (exists && own.place != BlockLink::kNone) {
      const std::uint16_t* places = room.places + own_begin;
      const unsigned long long key = room.keys[contact];
      const std::uint32_t degree = BlockDegree::of(room.degree[own.body]);
      rank = 0;
#pragma unroll 4
      for (std::uint32_t k = 0; k < degree; ++k) rank += room.keys[places[k]] < key ? 1U : 0U;
    }
    const std::uint32_t rank_other = __shfl_xor_sync(kFullWarp, rank, 1);
    if (rank == kNoRank) continue;
    const bool by_i = is_resolved_by_i(link.pair(), is_i ? rank : rank_other, is_i ? rank_other : rank);
    room.lists[own_begin + rank] = BlockEntry(contact, link.side(!is_i).body, rank_other, is_i == by_i);
  }
}

// Called by all threads of one block, for bodies and pairs that fit `room`, which has the counts afterwards. Calls
// `ended` when contacts are resolved.
template <typename Ended>
__device__ void resolve_in_block(const FrameView& f, const NarrowPairs& pairs, const BlockRoom& room,
                                 const Ended& ended) {
  const std::uint32_t body = threadIdx.x;
  const bool is_body = body < f.body_count;
  const BlockLive live{room.live};
  // All of this is loaded before any of it is used, so that a thread waits once.
  const NarrowPair first(f, pairs, threadIdx.x);
  PackedVec3 x;
  PackedVec3 v;
  ContactSide side;
  core::Material material;  // loaded early: the threads that resolve the body's contacts then find it in the cache
  if (is_body) {
    x = f.detected.position[body];
    v = f.detected.velocity[body];
    side = contact_side(f, body);
    material = f.material[body];
    room.degree[body] = BlockDegree::zero(is_written(f, body));
  }
  if (threadIdx.x == 0) *room.counts = {};
  __syncthreads();
  collect_in_block(f, first, pairs, room);
  if (is_body) live.write(body, {x.v, 0, v.v, 0});
  __syncthreads();
  core::Kinematics state{x.v, v.v};
  if (const std::uint32_t count = room.counts->touching; count > 0) {
    list_in_block(f, count, room);
    __syncthreads();
    if (is_body)
      BodyTurn(f, live, body, ListInBlock(f, room.lists + room.list_begin[body], BlockDegree::of(room.degree[body])),
               side)
          .resolve_all();
    __syncthreads();
    LiveBody last;
    if (is_body) last = live.fetch(body);
    const std::uint32_t colors = ~warp_min(~(last.tag >> 1));
    if (lane() == 0 && colors > 0) atomicMax(&room.counts->colors, colors);
    state = {last.x, last.v};
  }
  ended();
  const bool moves = is_body && x.w > 0.0F;
  const core::Kinematics after = settled_at_faces(
      f, body, moves, side.local_box, x.w, [&] { return material; }, state, &room.counts->faces);
  if (is_body) {
    f.next.position[body] = {after.x, x.w};
    f.next.velocity[body] = {after.v, v.w};
  }
  __syncthreads();
}

}  // namespace broadside::gpu
