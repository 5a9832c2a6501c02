// Packed words by which threads of a block exchange results, and the choice that a warp makes together, against plain
// counting.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/response/block_room.cuh"
#include "gpu/stages/vertices/search_stack.cuh"

namespace broadside::gpu {
namespace {

TEST(BlockEntry, KeepsWhatItIsGiven) {
  std::vector<std::uint32_t> shapes(BlockEntry::kMostBodies);
  for (std::uint32_t body = 0; body < shapes.size(); ++body) shapes[body] = 3 * body;
  FrameView f;
  f.shapes.count = 2;
  f.shape_of_body = shapes.data();
  for (const std::uint32_t contact : {0U, 1U, BlockEntry::kMostContacts - 1}) {
    for (const std::uint32_t other : {0U, 7U, BlockEntry::kMostBodies - 1}) {
      for (const std::uint32_t rank : {0U, 5U, BlockEntry::kMostBodies - 2, kNoRank}) {
        for (const bool is_ours : {false, true}) {
          const ListEntry entry = BlockEntry(contact, other, rank, is_ours).unpacked(f);
          EXPECT_EQ(entry.contact, contact);
          EXPECT_EQ(entry.other, other);
          EXPECT_EQ(entry.rank_other, rank);
          EXPECT_EQ(entry.shape & ~ListEntry::kIsOurs, shapes[other]);
          EXPECT_EQ((entry.shape & ListEntry::kIsOurs) != 0, is_ours);
        }
      }
    }
  }
}

TEST(BlockLink, KnowsBodiesThatAreNeverWritten) {
  std::uint32_t written = BlockDegree::zero(true);
  std::uint32_t unwritten = BlockDegree::zero(false);
  for (std::uint32_t place = 0; place < 3; ++place) {
    const BlockLink link({4, 511}, BlockDegree::count(&written), BlockDegree::count(&unwritten));
    EXPECT_EQ(link.side(true).body, 4U);
    EXPECT_EQ(link.side(true).place, place);
    EXPECT_EQ(link.side(false).body, 511U);
    EXPECT_EQ(link.side(false).place, BlockLink::kNone);
  }
  EXPECT_EQ(BlockDegree::of(written), 3U);
  EXPECT_EQ(BlockDegree::of(unwritten), 0U) << "it has no list";
}

// The arrays must neither overlap nor pass the end when they just fit, and a byte less must not fit.
TEST(BlockRoom, FitsWhatItHolds) {
  for (const std::uint32_t bodies : {1U, 2U, 33U, 512U}) {
    for (const std::uint32_t pairs : {0U, 1U, 7U, 500U}) {
      FrameView f;
      f.body_count = f.block_bodies = bodies;
      while (!BlockRoom::fits(f, pairs)) ++f.block_bytes;
      std::vector<uint4> memory(f.block_bytes / sizeof(uint4) + 1);
      auto* shared = reinterpret_cast<unsigned char*>(memory.data());
      const BlockRoom room(shared, bodies, pairs);
      const auto at = [shared](const void* p) { return static_cast<const unsigned char*>(p) - shared; };
      EXPECT_EQ(at(room.counts) % alignof(BlockCounts), 0U);
      EXPECT_EQ(at(room.keys) % 8, 0U);
      EXPECT_LE(at(room.live + bodies), at(room.counts));
      EXPECT_LE(at(room.counts + 1), at(room.keys));
      EXPECT_LE(at(room.keys + pairs), at(room.links));
      EXPECT_LE(at(room.links + pairs), at(room.lists));
      EXPECT_LE(at(room.lists + 2 * pairs), at(room.degree));
      EXPECT_LE(at(room.degree + bodies), at(room.list_begin));
      EXPECT_LE(at(room.list_begin + bodies), at(room.places));
      EXPECT_EQ(at(room.places + 2 * pairs), f.block_bytes);
    }
  }
  FrameView f;
  f.block_bytes = 1U << 30;
  f.body_count = f.block_bodies = BlockEntry::kMostBodies;
  EXPECT_TRUE(BlockRoom::fits(f, BlockEntry::kMostContacts));
  EXPECT_FALSE(BlockRoom::fits(f, BlockEntry::kMostContacts + 1));
  f.body_count = f.block_bodies = BlockEntry::kMostBodies + 1;
  EXPECT_FALSE(BlockRoom::fits(f, 1));
}

// Few distances and few vertices, so that lanes tie in every word.
TEST(WarpNearest, IsTheFirstOfAllLanes) {
  std::mt19937 random(9);
  const auto below = [&random](unsigned most) { return static_cast<std::uint32_t>(random() % most); };
  for (int round = 0; round < 200; ++round) {
    const unsigned kinds = 1 + round % 4;
    std::vector<core::Proximity> lanes(32);
    core::Proximity nearest;
    for (core::Proximity& p : lanes) {
      if (below(8) != 0) p = {0.25F * static_cast<float>(below(kinds)), below(kinds), below(3)};
      if (core::is_nearer(p, nearest)) nearest = p;
    }
    on_host::run(on_host::kOneWarp, 0,
                 [&](unsigned char*) { EXPECT_EQ(warp_nearest(lanes[threadIdx.x]), nearest) << round; });
  }
}

}  // namespace
}  // namespace broadside::gpu
