// What the host side asks of the device: memory, copies, waiting. Two files implement it, one with CUDA and one in
// on_host/, where a "device" is the host itself.
#pragma once

#include <cstddef>

#include "core/result.hpp"

struct CUstream_st;

namespace broadside::gpu {

// cudaStream_t, without CUDA's headers.
using StreamHandle = CUstream_st*;

// Null and an error when there is not enough memory; the error names the amount.
core::Result<void*> allocate_device_bytes(std::size_t bytes, const char* what);
void release_device_bytes(void* memory);
// These return when the bytes have been read or are there.
core::Status copy_to_device(void* to, const void* from, std::size_t bytes);
core::Status copy_to_host(void* to, const void* from, std::size_t bytes);
core::Status fill_device_bytes(void* memory, int value, std::size_t bytes);
// Until everything that was asked of the device is done.
core::Status wait_for_device(const char* what);

// Memory of the host that the device writes, as each of them sees it.
struct MappedMemory {
  void* host = nullptr;
  void* device = nullptr;
};
core::Result<MappedMemory> allocate_mapped_bytes(std::size_t bytes);
void release_mapped_bytes(const MappedMemory& memory);

// The stream of all pipelines of this process: their frames never run side by side (stages/grid/dependent_launch.cuh
// says why).
core::Result<StreamHandle> frame_stream();
core::Result<StreamHandle> create_stream();
void release_stream(StreamHandle stream);
core::Status wait_for_stream(StreamHandle stream, const char* what);

// Asked of the stream, which does it in its turn; these return at once.
core::Status copy_on_device(void* to, const void* from, std::size_t bytes, StreamHandle stream);
// The host's memory is pinned: of allocate_mapped_bytes.
core::Status start_copy_to_host(void* to, const void* from, std::size_t bytes, StreamHandle stream);

// A place in a stream's order, for another stream or the host to wait for.
class StreamMark {
 public:
  StreamMark() = default;
  StreamMark(const StreamMark&) = delete;
  StreamMark& operator=(const StreamMark&) = delete;
  ~StreamMark();  // NOLINT(performance-trivially-destructible): on_host/ has nothing to end
  core::Status set(StreamHandle stream);
  // What is asked of that stream from now on runs after the mark.
  core::Status hold_back(StreamHandle other) const;
  [[nodiscard]] core::Status wait(const char* what) const;

 private:
  void* event_ = nullptr;
};

// Times work of a stream by the device's own events.
class StreamTimer {
 public:
  StreamTimer() = default;
  StreamTimer(const StreamTimer&) = delete;
  StreamTimer& operator=(const StreamTimer&) = delete;
  ~StreamTimer();  // NOLINT(performance-trivially-destructible): on_host/ has nothing to end
  core::Status start(StreamHandle stream);
  core::Status stop(StreamHandle stream);
  // After the stream was waited for. 0 where there are no events.
  [[nodiscard]] double elapsed_s() const;

 private:
  void* begin_ = nullptr;
  void* end_ = nullptr;
};

}  // namespace broadside::gpu

// Returns the Error from the enclosing function when the call fails.
#define BROADSIDE_TRY(call)                                                                      \
  do {                                                                                           \
    if (auto broadside_status = (call); !broadside_status.ok()) return broadside_status.error(); \
  } while (false)
