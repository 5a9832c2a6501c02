#include <cstdlib>
#include <cstring>

#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<void*> allocate_device_bytes(std::size_t bytes, const char* what) {
  void* memory = std::malloc(bytes);
  if (memory == nullptr) return core::Error{"out of memory", what, "use a smaller scene", core::Exit::kMissing};
  std::memset(memory, 0xA5, bytes);  // as on a GPU, new memory is not zero
  return memory;
}

void release_device_bytes(void* memory) {
  std::free(memory);
}

core::Status copy_to_device(void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return core::Done{};
}

core::Status copy_to_host(void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return core::Done{};
}

core::Status fill_device_bytes(void* memory, int value, std::size_t bytes) {
  std::memset(memory, value, bytes);
  return core::Done{};
}

core::Status wait_for_device(const char* /*what*/) {
  return core::Done{};
}

core::Result<MappedMemory> allocate_mapped_bytes(std::size_t bytes) {
  void* memory = std::calloc(1, bytes);
  if (memory == nullptr) return core::Error{"out of memory", "mapped memory", "free some", core::Exit::kMissing};
  return MappedMemory{memory, memory};
}

void release_mapped_bytes(const MappedMemory& memory) {
  std::free(memory.host);
}

core::Result<StreamHandle> frame_stream() {
  return StreamHandle{nullptr};
}

core::Result<StreamHandle> create_stream() {
  return StreamHandle{nullptr};
}

void release_stream(StreamHandle /*stream*/) {}

core::Status wait_for_stream(StreamHandle /*stream*/, const char* /*what*/) {
  return core::Done{};
}

core::Status copy_on_device(void* to, const void* from, std::size_t bytes, StreamHandle /*stream*/) {
  std::memcpy(to, from, bytes);
  return core::Done{};
}

core::Status start_copy_to_host(void* to, const void* from, std::size_t bytes, StreamHandle /*stream*/) {
  std::memcpy(to, from, bytes);
  return core::Done{};
}

StreamMark::~StreamMark() = default;

core::Status StreamMark::set(StreamHandle /*stream*/) {
  event_ = this;
  return core::Done{};
}

core::Status StreamMark::hold_back(StreamHandle /*other*/) const {
  return core::Done{};
}

core::Status StreamMark::wait(const char* /*what*/) const {
  return core::Done{};
}

StreamTimer::~StreamTimer() = default;

core::Status StreamTimer::start(StreamHandle /*stream*/) {
  return core::Done{};
}

core::Status StreamTimer::stop(StreamHandle /*stream*/) {
  return core::Done{};
}

double StreamTimer::elapsed_s() const {
  return begin_ == end_ ? 0.0 : 1.0;
}

}  // namespace broadside::gpu
