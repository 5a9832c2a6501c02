// Reads a finder's pairs: all at once, or chunk by chunk.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/engine/pair_chunks.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {

// Every seventh box is static.
inline tests::BoxCase case_of(std::vector<core::Box> boxes) {
  tests::BoxCase c;
  c.is_static.resize(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); k += 7) c.is_static[k] = 1;
  c.boxes = std::move(boxes);
  return c;
}

template <typename Finder>
std::vector<core::Pair> pairs_of(Finder& finder) {
  const core::Status status = finder.find();
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().line());
  auto found = finder.read_back();
  EXPECT_TRUE(found.ok());
  if constexpr (requires { finder.pair_count(); }) {
    EXPECT_EQ(finder.pair_count(), found.value().pairs.size());
  }
  return std::move(found.value().pairs);
}

struct Chunks {
  std::vector<core::Pair> pairs;  // of all chunks, sorted
  std::size_t count = 0;
  std::uint64_t largest = 0;
};

template <typename Finder>
Chunks handed_on(Finder& finder) {
  Chunks chunks;
  const core::Status status = finder.hand_on([&](const core::DevicePairs& chunk) -> core::Status {
    chunks.pairs.insert(chunks.pairs.end(), chunk.data, chunk.data + chunk.count);
    ++chunks.count;
    chunks.largest = std::max(chunks.largest, chunk.count);
    return core::Done{};
  });
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().line());
  std::sort(chunks.pairs.begin(), chunks.pairs.end());
  return chunks;
}

}  // namespace broadside::gpu
