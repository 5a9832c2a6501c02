#include <cuda_runtime_api.h>

#include <cstdio>
#include <string>

#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/device_runtime.hpp"

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
  (void)cudaGetLastError();  // clear the error, so that the next call does not report it
  if (code != cudaErrorMemoryAllocation) return cuda_status(code, "cudaMalloc").error();
  std::size_t free = 0;
  std::size_t total = 0;
  (void)cudaMemGetInfo(&free, &total);
  return core::Error{"out of device memory: " + std::string(what) + " needs " + megabytes(bytes) + ", " +
                         megabytes(free) + " of " + megabytes(total) + " are free",
                     "GPU", "use a smaller scene or a GPU with more memory", core::Exit::kMissing};
}

void release_device_bytes(void* memory) {
  cudaFree(memory);  // a destructor calls this: an error cannot be returned
}

core::Status copy_to_device(void* to, const void* from, std::size_t bytes) {
  return cuda_status(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice), "copying to the device");
}

core::Status copy_to_host(void* to, const void* from, std::size_t bytes) {
  return cuda_status(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "copying from the device");
}

core::Status fill_device_bytes(void* memory, int value, std::size_t bytes) {
  return cuda_status(cudaMemset(memory, value, bytes), "clearing device memory");
}

core::Status wait_for_device(const char* what) {
  return cuda_status(cudaDeviceSynchronize(), what);
}

core::Result<MappedMemory> allocate_mapped_bytes(std::size_t bytes) {
  MappedMemory memory;
  BROADSIDE_CUDA_TRY(cudaHostAlloc(&memory.host, bytes, cudaHostAllocMapped));
  if (const core::Status s = cuda_status(cudaHostGetDevicePointer(&memory.device, memory.host, 0), "mapping memory");
      !s.ok()) {
    cudaFreeHost(memory.host);
    return s.error();
  }
  return memory;
}

void release_mapped_bytes(const MappedMemory& memory) {
  cudaFreeHost(memory.host);
}

core::Result<StreamHandle> create_stream() {
  cudaStream_t stream = nullptr;
  BROADSIDE_CUDA_TRY(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking));
  return stream;
}

core::Result<StreamHandle> frame_stream() {
  static const core::Result<StreamHandle> stream = create_stream();
  return stream;
}

void release_stream(StreamHandle stream) {
  cudaStreamDestroy(stream);
}

core::Status wait_for_stream(StreamHandle stream, const char* what) {
  return cuda_status(cudaStreamSynchronize(stream), what);
}

core::Status copy_on_device(void* to, const void* from, std::size_t bytes, StreamHandle stream) {
  return cuda_status(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, stream), "copying on the device");
}

core::Status start_copy_to_host(void* to, const void* from, std::size_t bytes, StreamHandle stream) {
  return cuda_status(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream), "copying from the device");
}

StreamMark::~StreamMark() {
  if (event_ != nullptr) cudaEventDestroy(static_cast<cudaEvent_t>(event_));
}

core::Status StreamMark::set(StreamHandle stream) {
  if (event_ == nullptr) {
    cudaEvent_t made = nullptr;
    BROADSIDE_CUDA_TRY(cudaEventCreateWithFlags(&made, cudaEventDisableTiming));
    event_ = made;
  }
  return cuda_status(cudaEventRecord(static_cast<cudaEvent_t>(event_), stream), "marking a stream");
}

core::Status StreamMark::hold_back(StreamHandle other) const {
  return cuda_status(cudaStreamWaitEvent(other, static_cast<cudaEvent_t>(event_), 0), "ordering two streams");
}

core::Status StreamMark::wait(const char* what) const {
  return cuda_status(cudaEventSynchronize(static_cast<cudaEvent_t>(event_)), what);
}

StreamTimer::~StreamTimer() {
  if (begin_ != nullptr) cudaEventDestroy(static_cast<cudaEvent_t>(begin_));
  if (end_ != nullptr) cudaEventDestroy(static_cast<cudaEvent_t>(end_));
}

core::Status StreamTimer::start(StreamHandle stream) {
  for (void** event : {&begin_, &end_}) {
    if (*event != nullptr) continue;
    cudaEvent_t made = nullptr;
    BROADSIDE_CUDA_TRY(cudaEventCreate(&made));
    *event = made;
  }
  return cuda_status(cudaEventRecord(static_cast<cudaEvent_t>(begin_), stream), "timing");
}

core::Status StreamTimer::stop(StreamHandle stream) {
  return cuda_status(cudaEventRecord(static_cast<cudaEvent_t>(end_), stream), "timing");
}

double StreamTimer::elapsed_s() const {
  float ms = 0.0F;
  const bool is_known = begin_ != nullptr && cudaEventElapsedTime(&ms, static_cast<cudaEvent_t>(begin_),
                                                                  static_cast<cudaEvent_t>(end_)) == cudaSuccess;
  return is_known ? static_cast<double>(ms) * 1e-3 : 0.0;
}

}  // namespace broadside::gpu
