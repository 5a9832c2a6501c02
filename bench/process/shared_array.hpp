// An array that forked children write and their parent reads: what a child wrote stays readable after it died.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace broadside::bench {

// Zeroed memory that a fork shares; null when there is none.
void* map_shared(std::size_t bytes);
void unmap_shared(void* memory, std::size_t bytes);

template <typename T>
class SharedArray {
  static_assert(std::is_trivially_copyable_v<T>, "another process sees its bytes and nothing else");

 public:
  // Elements have their default value. Throws std::bad_alloc.
  explicit SharedArray(std::size_t count) : count_(count) {
    if (count == 0) return;
    void* memory = map_shared(count * sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    data_ = static_cast<T*>(memory);
    std::uninitialized_value_construct_n(data_, count);
  }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;
  ~SharedArray() {
    if (data_ != nullptr) unmap_shared(data_, count_ * sizeof(T));
  }

  [[nodiscard]] std::span<T> all() { return {data_, count_}; }
  T& operator[](std::size_t k) { return data_[k]; }

 private:
  T* data_ = nullptr;
  std::size_t count_;
};

}  // namespace broadside::bench
