// Finds how many blocks of a kernel with barriers over its whole grid this GPU can hold, and launches such a kernel.
#pragma once

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"

namespace broadside::gpu {

inline core::Result<std::uint32_t> attribute(cudaDeviceAttr which) {
  int device = 0;
  int value = 0;
  BROADSIDE_CUDA_TRY(cudaGetDevice(&device));
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&value, which, device));
  return static_cast<std::uint32_t>(value);
}

// Sets how many of a kernel's blocks are resident at once; `shape` must have threads and shared memory.
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

// When the blocks of a launch begin.
enum class LaunchBegin : std::uint8_t {
  // Once all of them can be resident together: CUDA's cooperative launch.
  kTogether,
  // Each block as soon as there is room, while the launch before it in the stream ends. dependent_launch.cuh says why
  // all of them become resident.
  kDependent,
};

template <typename View>
core::Status launch(void (*kernel)(View), const View& view, const LaunchShape& shape, StreamHandle stream,
                    LaunchBegin begin = LaunchBegin::kTogether) {
  cudaLaunchAttribute attribute = {};
  if (begin == LaunchBegin::kTogether) {
    attribute.id = cudaLaunchAttributeCooperative;
    attribute.val.cooperative = 1;
  } else {
    attribute.id = cudaLaunchAttributeProgrammaticStreamSerialization;
    attribute.val.programmaticStreamSerializationAllowed = 1;
  }
  cudaLaunchConfig_t config = {};
  config.gridDim = dim3(shape.blocks);
  config.blockDim = dim3(shape.threads);
  config.dynamicSmemBytes = shape.shared_bytes;
  config.stream = stream;
  config.attrs = &attribute;
  config.numAttrs = 1;
  void* arguments[] = {const_cast<View*>(&view)};
  return cuda_status(cudaLaunchKernelExC(&config, reinterpret_cast<const void*>(kernel), arguments),
                     "launching a kernel");
}

}  // namespace broadside::gpu
