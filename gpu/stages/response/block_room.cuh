// The data that one block keeps in its shared memory while it resolves contacts alone, and how much fits.
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// A touching pair, and its place among the contacts of each body. A body and a place have 16 bits each.
class BlockLink {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFU;  // for a body that is never written
  struct Side {
    std::uint32_t body = 0;
    std::uint32_t place = kNone;
  };

  BlockLink() = default;
  // A place of kNone or more means that there is none.
  __device__ BlockLink(core::Pair p, std::uint32_t place_i, std::uint32_t place_j)
      : i_(p.i | min(place_i, kNone) << 16U), j_(p.j | min(place_j, kNone) << 16U) {}

  __device__ Side side(bool is_i) const {
    const std::uint32_t word = is_i ? i_ : j_;
    return {word & 0xFFFFU, word >> 16U};
  }
  __device__ core::Pair pair() const { return {side(true).body, side(false).body}; }

 private:
  std::uint32_t i_ = 0;
  std::uint32_t j_ = 0;
};

// A ListEntry, except the shape, in one word: from the lowest bit on, 13 bits for the contact, 9 for the other body, 9
// for the rank there, and one that says which body's thread resolves.
class BlockEntry {
 public:
  static constexpr std::uint32_t kMostContacts = 1U << 13;
  static constexpr std::uint32_t kMostBodies = 1U << 9;

  BlockEntry() = default;
  __device__ BlockEntry(std::uint32_t contact, std::uint32_t other, std::uint32_t rank_other, bool is_ours)
      : word_(contact | other << 13U | min(rank_other, kNone) << 22U | (is_ours ? ListEntry::kIsOurs : 0U)) {}

  __device__ ListEntry unpacked(const FrameView& f) const {
    const std::uint32_t other = word_ >> 13U & (kMostBodies - 1);
    const std::uint32_t rank = word_ >> 22U & kNone;
    return {word_ & (kMostContacts - 1), other, rank == kNone ? kNoRank : rank,
            shape_of(f, other) | (word_ & ListEntry::kIsOurs)};
  }

 private:
  static constexpr std::uint32_t kNone = kMostBodies - 1;  // no body has so many others

  std::uint32_t word_ = 0;
};
static_assert(ListEntry::kIsOurs == 1U << 31);

// As in Counters, but with 32 bits, on which atomics are faster.
struct alignas(16) BlockCounts {
  std::uint32_t touching = 0;
  std::uint32_t listed = 0;
  std::uint32_t faces = 0;
  std::uint32_t colors = 0;
};

// The number of a body's contacts while they are counted, or a mark for a body that is never written.
class BlockDegree {
 public:
  __device__ static std::uint32_t zero(bool is_written) { return is_written ? 0U : kUnwritten; }
  // A place as BlockLink takes it.
  __device__ static std::uint32_t count(std::uint32_t* word) { return atomicAdd(word, 1U); }
  __device__ static std::uint32_t of(std::uint32_t word) { return word < kUnwritten ? word : 0U; }

 private:
  static constexpr std::uint32_t kUnwritten = 1U << 31;
};
static_assert(BlockLink::kNone < 1U << 31);

// The arrays, aligned to 16 bytes. They mean the same as those of FrameView with the same names.
struct BlockRoom {
  LiveBody* live;             // [bodies]
  BlockCounts* counts;        // [1]
  unsigned long long* keys;   // [pairs] by contact
  BlockLink* links;           // [pairs]
  BlockEntry* lists;          // [2 * pairs]
  std::uint32_t* degree;      // [bodies] of BlockDegree
  std::uint32_t* list_begin;  // [bodies]
  std::uint16_t* places;      // [2 * pairs] contacts of each written body, as they came

  __device__ BlockRoom(unsigned char* shared, std::uint32_t bodies, std::uint32_t pairs) {
    live = reinterpret_cast<LiveBody*>(shared);
    counts = reinterpret_cast<BlockCounts*>(live + bodies);
    keys = reinterpret_cast<unsigned long long*>(counts + 1);
    links = reinterpret_cast<BlockLink*>(keys + pairs);
    lists = reinterpret_cast<BlockEntry*>(links + pairs);
    degree = reinterpret_cast<std::uint32_t*>(lists + 2 * pairs);
    list_begin = degree + bodies;
    places = reinterpret_cast<std::uint16_t*>(list_begin + bodies);
  }

  // Whether a block has enough threads and memory, and an entry enough bits.
  __device__ static bool fits(const FrameView& f, std::uint64_t pairs) {
    constexpr std::uint32_t kBytesOfBody = sizeof(LiveBody) + 2 * sizeof(std::uint32_t);
    constexpr std::uint32_t kBytesOfPair =
        sizeof(unsigned long long) + sizeof(BlockLink) + 2 * sizeof(BlockEntry) + 2 * sizeof(std::uint16_t);
    return f.body_count <= f.block_bodies && f.body_count <= BlockEntry::kMostBodies &&
           pairs <= BlockEntry::kMostContacts &&
           sizeof(BlockCounts) + f.body_count * kBytesOfBody + pairs * kBytesOfPair <= f.block_bytes;
  }
};

}  // namespace broadside::gpu
