// The grid in which frames run on the host: two blocks of two warps, so that at every kind of barrier threads have
// others to wait for.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace broadside::gpu::on_host {

inline constexpr std::uint32_t kThreads = 64;
inline constexpr std::uint32_t kBlocks = 2;

// With a seed the fibers run in another order in each round; with 0 always one after another.
inline std::uint64_t order_seed() {
  const char* text = std::getenv("BROADSIDE_ON_HOST_SEED");  // NOLINT(concurrency-mt-unsafe)
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
}

}  // namespace broadside::gpu::on_host
