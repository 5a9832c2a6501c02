// Many arrays of one type in one allocation of device memory, for views that point into it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

template <typename T>
class DeviceTable {
 public:
  void clear() { items_.clear(); }
  // Returns where they begin: the argument of at().
  std::size_t add(std::span<const T> items) {
    const std::size_t first = items_.size();
    items_.insert(items_.end(), items.begin(), items.end());
    return first;
  }
  core::Status upload(const char* what) { return buffer_.upload(items_, what); }
  [[nodiscard]] const T* at(std::size_t first) const { return buffer_.data() + first; }
  [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

 private:
  std::vector<T> items_;
  DeviceBuffer<T> buffer_;
};

}  // namespace broadside::gpu
