#include "gpu/device_buffer.hpp"

#include <cstdio>

namespace broadside::gpu {
namespace {

std::string megabytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

}  // namespace

core::Result<void*> allocate_device_bytes(std::size_t bytes, const char* what) {
  void* memory = nullptr;
  const cudaError_t code = cudaMalloc(&memory, bytes);
  if (code == cudaSuccess) return memory;
  (void)cudaGetLastError();  // an allocation that failed must not fail the next call
  if (code != cudaErrorMemoryAllocation) return cuda_status(code, "cudaMalloc").error();
  std::size_t free = 0;
  std::size_t total = 0;
  (void)cudaMemGetInfo(&free, &total);
  return core::Error{"out of device memory: " + std::string(what) + " needs " + megabytes(bytes) + ", " +
                         megabytes(free) + " of " + megabytes(total) + " are free",
                     "octree-gpu", "use a smaller scene or a GPU with more memory", core::Exit::kMissing};
}

}  // namespace broadside::gpu
