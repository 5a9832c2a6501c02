// The launches on fibers of the host: two blocks of two warps, so that every kind of barrier has somebody to wait for.
#include <algorithm>
#include <cstdlib>

#include "gpu/frame_kernel.hpp"
#include "gpu/stages/digest.cuh"
#include "gpu/stages/frame.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 64;
constexpr std::uint32_t kBlocks = 2;

// A test that sets the seed runs the fibers in another order each round; 0 = one after another.
std::uint64_t seed() {
  const char* text = std::getenv("BROADSIDE_ON_HOST_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
}

on_host::Launch launch_of(const LaunchShape& shape) {
  return {{shape.blocks}, {shape.threads}, seed()};
}

}  // namespace

core::Result<LaunchShape> frame_launch_shape(std::uint32_t tree_levels) {
  const std::uint32_t bytes_per_warp = std::max(stack_entries_of(tree_levels) * kBytesPerStackEntry,
                                                static_cast<std::uint32_t>((sizeof(PairQueue) + 15) / 16 * 16));
  return LaunchShape{kThreads, kBlocks, kThreads / 32 * bytes_per_warp, kBlocks};
}

core::Status launch_frame(const FrameView& frame, const LaunchShape& shape, StreamHandle /*stream*/) {
  std::vector<ProximityScratch> scratch(shape.blocks);
  on_host::run(launch_of(shape), shape.shared_bytes, [&](unsigned char* shared) {
    if (has_few_bodies(frame, std::uint64_t{shape.blocks} * shape.threads))
      run_frame<true>(frame, scratch[blockIdx.x], shared);
    else
      run_frame<false>(frame, scratch[blockIdx.x], shared);
  });
  return core::Done{};
}

core::Result<LaunchShape> pairs_launch_shape() {
  return LaunchShape{kThreads, kBlocks, kThreads / 32 * static_cast<std::uint32_t>(sizeof(PairQueue)), kBlocks};
}

core::Status launch_pairs(const PairsView& view, const LaunchShape& shape, StreamHandle /*stream*/) {
  on_host::run(launch_of(shape), shape.shared_bytes, [&](unsigned char* shared) { run_pairs(view, shared); });
  return core::Done{};
}

core::Status launch_digest(const DigestView& view, std::uint32_t /*multiprocessors*/, StreamHandle /*stream*/) {
  std::vector<unsigned long long> sums(kBlocks);
  on_host::run({{kBlocks}, {kThreads}, seed()}, 0, [&](unsigned char*) { run_digest(view, &sums[blockIdx.x]); });
  return core::Done{};
}

}  // namespace broadside::gpu
