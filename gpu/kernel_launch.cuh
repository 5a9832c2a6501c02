// How a kernel whose threads all meet at barriers fits this GPU, and its launch.
#pragma once

#include "gpu/cuda_check.hpp"
#include "gpu/frame_kernel.hpp"

namespace broadside::gpu {

inline core::Result<std::uint32_t> attribute(cudaDeviceAttr which) {
  int device = 0;
  int value = 0;
  BROADSIDE_CUDA_TRY(cudaGetDevice(&device));
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&value, which, device));
  return static_cast<std::uint32_t>(value);
}

// How many of a kernel's blocks are resident at once; `shape` has threads and shared memory.
inline core::Status fit(const void* kernel, LaunchShape& shape) {
  auto multiprocessors = attribute(cudaDevAttrMultiProcessorCount);
  if (!multiprocessors.ok()) return multiprocessors.error();
  shape.multiprocessors = multiprocessors.value();
  BROADSIDE_CUDA_TRY(
      cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shape.shared_bytes)));
  int each = 0;
  BROADSIDE_CUDA_TRY(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, kernel, static_cast<int>(shape.threads),
                                                                   shape.shared_bytes));
  shape.blocks = static_cast<std::uint32_t>(each) * shape.multiprocessors;
  return core::Done{};
}

template <typename View>
core::Status launch(void (*kernel)(View), const View& view, const LaunchShape& shape, StreamHandle stream) {
  void* arguments[] = {const_cast<View*>(&view)};
  return cuda_status(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(kernel), dim3(shape.blocks),
                                                 dim3(shape.threads), arguments, shape.shared_bytes, stream),
                     "launching a kernel");
}

}  // namespace broadside::gpu
