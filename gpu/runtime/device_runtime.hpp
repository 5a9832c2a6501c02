// What the host side needs from the device: memory, copies, waiting. Two files implement this header, one with CUDA and
// one in on_host/, where the "device" is the host itself.
#pragma once

#include <cstddef>

#include "core/result.hpp"

struct CUstream_st;

namespace broadside::gpu {

// cudaStream_t, without CUDA's headers.
using StreamHandle = CUstream_st*;

// An error if there is not enough memory; it names the amount.
core::Result<void*> allocate_device_bytes(std::size_t bytes, const char* what);
void release_device_bytes(void* memory);
// The copies return when the bytes have been read or are there; the fill may return earlier.
core::Status copy_to_device(void* to, const void* from, std::size_t bytes);
core::Status copy_to_host(void* to, const void* from, std::size_t bytes);
core::Status fill_device_bytes(void* memory, int value, std::size_t bytes);
// Waits until all work that was given to the device is done.
core::Status wait_for_device(const char* what);

// Memory of the host that the device writes: its address on either side.
struct MappedMemory {
  void* host = nullptr;
  void* device = nullptr;
};
core::Result<MappedMemory> allocate_mapped_bytes(std::size_t bytes);
void release_mapped_bytes(const MappedMemory& memory);

// The one stream of all pipelines of this process, so that their frames never run at the same time
// (stages/grid/dependent_launch.cuh says why).
core::Result<StreamHandle> frame_stream();
core::Result<StreamHandle> create_stream();
void release_stream(StreamHandle stream);
core::Status wait_for_stream(StreamHandle stream, const char* what);

// These put a copy into the stream and return at once.
core::Status copy_on_device(void* to, const void* from, std::size_t bytes, StreamHandle stream);
// The host's memory must be pinned: from allocate_mapped_bytes.
core::Status start_copy_to_host(void* to, const void* from, std::size_t bytes, StreamHandle stream);

// Marks a place in a stream, for which another stream or the host can wait.
class StreamMark {
 public:
  StreamMark() = default;
  StreamMark(const StreamMark&) = delete;
  StreamMark& operator=(const StreamMark&) = delete;
  ~StreamMark();  // NOLINT(performance-trivially-destructible): on_host/ has nothing to end
  core::Status set(StreamHandle stream);
  // Work that is put into the stream `other` from now on runs after the mark.
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
  // Valid once the stream was waited for. 0 if there are no events.
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
