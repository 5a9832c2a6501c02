// What the host owns of a running GPU engine: its stream, and the words that the device writes into the host's memory.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// An array of kCount values in host memory that the device writes; this object owns it.
template <typename T, std::size_t kCount>
class Mapped {
 public:
  Mapped() = default;
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  ~Mapped() {
    if (memory_.host != nullptr) release_mapped_bytes(memory_);
  }
  // Allocates at the first call; clears the values at each.
  core::Status allocate() {
    if (memory_.host == nullptr) {
      auto memory = allocate_mapped_bytes(kCount * sizeof(T));
      if (!memory.ok()) return memory.error();
      memory_ = memory.value();
    }
    std::fill_n(static_cast<T*>(memory_.host), kCount, T{});
    return core::Done{};
  }
  [[nodiscard]] T* device(std::size_t k) const { return static_cast<T*>(memory_.device) + k; }
  [[nodiscard]] T& operator[](std::size_t k) const { return static_cast<T*>(memory_.host)[k]; }

 private:
  MappedMemory memory_;
};

class Stream {
 public:
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (is_created_) release_stream(stream_);
  }
  core::Status create() {
    if (is_created_) return core::Done{};
    auto stream = create_stream();
    if (!stream.ok()) return stream.error();
    stream_ = stream.value();
    is_created_ = true;
    return core::Done{};
  }
  core::Status wait(const char* what) const { return wait_for_stream(stream_, what); }
  [[nodiscard]] StreamHandle get() const { return stream_; }

 private:
  StreamHandle stream_ = nullptr;
  bool is_created_ = false;
};

}  // namespace broadside::gpu
