#include <cuda_runtime_api.h>

#include <mutex>
#include <set>
#include <utility>

#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {

core::Result<int> device_count() {
  int count = 0;
  BROADSIDE_CUDA_TRY(cudaGetDeviceCount(&count));
  return count;
}

core::Result<int> current_device() {
  int device = 0;
  BROADSIDE_CUDA_TRY(cudaGetDevice(&device));
  return device;
}

core::Status use_device(int device) {
  return cuda_status(cudaSetDevice(device), "choosing a device");
}

core::Status let_reach(int device, int peer) {
  if (device == peer) return core::Done{};
  // Access stays enabled for the whole process. Enabling it again is an error, which CUDA's checkers report.
  static std::mutex mutex;
  static std::set<std::pair<int, int>> enabled;
  const std::lock_guard lock(mutex);
  if (enabled.contains({device, peer})) return core::Done{};
  int can = 0;
  BROADSIDE_CUDA_TRY(cudaDeviceCanAccessPeer(&can, device, peer));
  if (can == 0) return core::Done{};
  BROADSIDE_TRY(use_device(device));
  const cudaError_t code = cudaDeviceEnablePeerAccess(peer, 0);
  if (code == cudaErrorPeerAccessAlreadyEnabled)  // by other code of this process
    (void)cudaGetLastError();                     // clear the error for the next call
  else
    BROADSIDE_TRY(cuda_status(code, "reaching another device"));
  enabled.emplace(device, peer);
  return core::Done{};
}

core::Status copy_between_devices(void* to, int to_device, const void* from, int from_device, std::size_t bytes,
                                  StreamHandle stream) {
  return cuda_status(cudaMemcpyPeerAsync(to, to_device, from, from_device, bytes, stream), "copying between devices");
}

}  // namespace broadside::gpu
