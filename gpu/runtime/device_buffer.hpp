// Device memory that this object owns.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

template <typename T>
class DeviceBuffer {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  DeviceBuffer() = default;
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;
  DeviceBuffer(DeviceBuffer&& other) noexcept { swap(other); }
  DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~DeviceBuffer() { release(); }

  // Makes room for at least this many elements, and for at least one, so that data() is never null. Contents are lost
  // when it grows: the old memory is released first, so that growing does not need room for both.
  core::Status reserve(std::size_t count, const char* what) {
    if (data_ != nullptr && count <= capacity_) return core::Done{};
    release();
    const std::size_t wanted = count == 0 ? 1 : count;
    core::Result<void*> memory = allocate_device_bytes(wanted * sizeof(T), what);
    if (!memory.ok()) return memory.error();
    data_ = static_cast<T*>(memory.value());
    capacity_ = wanted;
    return core::Done{};
  }

  // Returns once the host's bytes were read.
  core::Status upload(std::span<const T> from, const char* what) {
    BROADSIDE_TRY(reserve(from.size(), what));
    if (!from.empty()) BROADSIDE_TRY(copy_to_device(data_, from.data(), from.size_bytes()));
    return core::Done{};
  }

  // Copies from another buffer, in the stream's order. Reserves more room than needed, because the next step's copy is
  // often larger.
  core::Status copy(const DeviceBuffer& from, std::size_t count, StreamHandle stream, const char* what) {
    if (data_ == nullptr || count > capacity_) BROADSIDE_TRY(reserve(count + count / 4, what));
    return count == 0 ? core::Status(core::Done{}) : copy_on_device(data_, from.data_, count * sizeof(T), stream);
  }

  // Synchronizes: returns when the bytes are there.
  core::Status download(std::vector<T>& to, std::size_t count) const {
    to.resize(count);
    if (count != 0) BROADSIDE_TRY(copy_to_host(to.data(), data_, count * sizeof(T)));
    return core::Done{};
  }

  core::Status fill_bytes(int value) {
    if (data_ != nullptr) BROADSIDE_TRY(fill_device_bytes(data_, value, capacity_ * sizeof(T)));
    return core::Done{};
  }

  void swap(DeviceBuffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
  }

  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  void release() {
    if (data_ != nullptr) release_device_bytes(data_);
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace broadside::gpu
