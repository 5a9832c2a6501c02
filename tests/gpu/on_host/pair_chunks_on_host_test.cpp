// Pairs that are handed on in chunks are those of trying all, each once, however small a chunk is; and places among
// pairs are counted beyond 2^32.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <string>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "tests/gpu/on_host/found_pairs.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

PairFinderOptions at_once(std::uint64_t pairs, std::uint32_t least_for_bins = 1U << 30) {
  PairFinderOptions options;
  options.pairs_at_once = pairs;
  options.least_for_grid = 50;
  options.least_for_bins = least_for_bins;
  options.least_for_passes = 50;
  return options;
}

TEST(PairChunksOnHost, OfEveryFamily) {
  std::size_t chunks = 0;
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 130, 3);
    const std::vector<Pair> expected = tests::every_pair(c);
    for (const std::uint32_t least_for_bins : {1U << 30, 50U}) {
      PairFinder finder(at_once(150, least_for_bins));
      ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
      const Chunks found = handed_on(finder);
      EXPECT_EQ(found.pairs, expected);
      chunks += found.count;
      auto gathered = finder.read_back();
      ASSERT_TRUE(gathered.ok());
      EXPECT_EQ(gathered.value().pairs, expected);
    }
  }
  EXPECT_GT(chunks, 2 * std::size(tests::kBoxFamilies));
}

TEST(PairChunksOnHost, NoneIsLargerThanAsked) {
  tests::BoxCase c;
  c.boxes = datasets::uniform_boxes(1200, 4);
  c.is_static.resize(c.boxes.size());
  PairFinder finder(at_once(500));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  const Chunks found = handed_on(finder);
  EXPECT_EQ(found.pairs, tests::every_pair(c));
  EXPECT_LE(found.largest, 500U);
  EXPECT_GE(found.count, found.pairs.size() / 500);
  // Where shares are equal, most chunks are near the size that is aimed at.
  EXPECT_LE(found.count, found.pairs.size() / 100);
  // Pairs in passes have chunks too.
  c.boxes = datasets::needle_boxes(900, 4);
  c.is_static.assign(c.boxes.size(), 0);
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_FALSE(finder.plan().is_plain());
  EXPECT_EQ(handed_on(finder).pairs, tests::every_pair(c));
}

// A pass by exponent finds some fifteen times as many pairs as it keeps. Chunks were once as small as if all of them
// were handed on: there were 94, some of which held four pairs.
TEST(PairChunksOnHost, APassThatFindsMoreThanItKeepsHasNoMoreChunks) {
  auto made = datasets::make_box_stream("boxes:exponents:6000");
  ASSERT_TRUE(made.ok());
  tests::BoxCase c;
  c.boxes = made.value().boxes;
  c.is_static.resize(c.boxes.size());
  PairFinder finder(at_once(400));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_FALSE(finder.plan().is_plain());
  const Chunks found = handed_on(finder);
  EXPECT_EQ(found.pairs, tests::every_pair(c));
  EXPECT_LE(found.largest, 400U);
  EXPECT_LE(found.count, 25U);
}

TEST(PairChunksOnHost, ABoxWithMorePairsThanAChunkIsAnErrorWithTheNumber) {
  const std::vector<Box> boxes(200, Box{{0, 0, 0}, {1, 1, 1}});
  PairFinder finder(at_once(100));
  ASSERT_TRUE(finder.load(boxes, std::vector<std::uint8_t>(200)).ok());
  const core::Status status = finder.find();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("one box alone has 199 pairs, and a chunk has room for 100"), std::string::npos)
      << status.error().line();
  EXPECT_FALSE(finder.pairs_on_device().ok());
}

TEST(PairChunksOnHost, AConsumerMayEndTheSearch) {
  PairFinder finder(at_once(100));
  const std::vector<Box> boxes = datasets::uniform_boxes(400, 1);
  ASSERT_TRUE(finder.load(boxes, std::vector<std::uint8_t>(400)).ok());
  int taken = 0;
  const core::Status status = finder.hand_on([&](const core::DevicePairs&) -> core::Status {
    if (++taken == 2) return core::Error{"that is enough"};
    return core::Done{};
  });
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(taken, 2);
}

// An array of 2^32 + 1000 pairs, with memory only for those that are written.
TEST(PairChunksOnHost, PlacesOfPairsGoBeyond32Bits) {
  constexpr std::uint64_t kCapacity = (1ULL << 32U) + 1000;
  void* memory = mmap(nullptr, kCapacity * sizeof(Pair), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  auto* const pairs = static_cast<Pair*>(memory);
  constexpr unsigned long long kBefore = (1ULL << 32U) - 40;
  unsigned long long demanded = kBefore;
  // 32 lanes, 40 pairs each: some below 2^32, some above, the last ones beyond the capacity.
  on_host::run(on_host::kOneWarp, sizeof(PairQueue), [&](unsigned char* shared) {
    WarpQueue queue(*reinterpret_cast<PairQueue*>(shared), {pairs, kCapacity}, &demanded);
    for (std::uint32_t k = 0; k < 40; ++k) queue.push(true, {k * 32 + threadIdx.x, 5000});
    queue.flush();
  });
  EXPECT_EQ(demanded, kBefore + 1280);
  std::vector<Pair> there(pairs + kBefore, pairs + kCapacity);
  for (std::uint32_t k = 0; k < there.size(); ++k) EXPECT_EQ(there[k], (Pair{k, 5000}));
  EXPECT_EQ(pairs[0], Pair{}) << "nothing went to its place modulo 2^32";
  munmap(memory, kCapacity * sizeof(Pair));
}

}  // namespace
}  // namespace broadside::gpu
