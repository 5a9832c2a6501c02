// Launches kernels without barriers over a number of items.
#pragma once

#include <algorithm>
#include <cstdint>

#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kPlainThreads = 256;
// Enough to hide the latency of reading memory once.
constexpr std::uint64_t kPlainBlocksPerMultiprocessor = 8;

template <typename View>
core::Status launch_over(std::uint64_t count, void (*kernel)(View), const View& view, StreamHandle stream,
                         std::uint32_t shared_bytes = 0) {
  auto multiprocessors = attribute(cudaDevAttrMultiProcessorCount);
  if (!multiprocessors.ok()) return multiprocessors.error();
  const std::uint64_t blocks = std::clamp<std::uint64_t>((count + kPlainThreads - 1) / kPlainThreads, 1,
                                                         kPlainBlocksPerMultiprocessor * multiprocessors.value());
  kernel<<<static_cast<std::uint32_t>(blocks), kPlainThreads, shared_bytes, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching a kernel");
}

}  // namespace broadside::gpu
