// The grid in which frames run on the host: two blocks of two warps, so that every kind of barrier has somebody to wait
// for.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace broadside::gpu::on_host {

inline constexpr std::uint32_t kThreads = 64;
inline constexpr std::uint32_t kBlocks = 2;

// A test that sets the seed runs the fibers in another order each round; 0 = one after another.
inline std::uint64_t order_seed() {
  const char* text = std::getenv("BROADSIDE_ON_HOST_SEED");  // NOLINT(concurrency-mt-unsafe)
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
}

}  // namespace broadside::gpu::on_host
