// Bytes of the protocol for program engines: little-endian numbers, texts with their length in front, rows of C structs
// as they are in memory.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace broadside::core {

static_assert(std::endian::native == std::endian::little, "rows are sent as they lie in memory");

// Types that may be sent as they are in memory: the structs of broadside_engine.h and broadside_engine_v2.h, and
// numbers.
template <typename T>
concept MessageRow = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

class MessageWriter {
 public:
  template <MessageRow T>
  MessageWriter& put(const T& value) {
    return rows(std::span<const T>(&value, 1));
  }
  MessageWriter& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size()));
    return rows(std::span<const char>(value.data(), value.size()));
  }
  template <MessageRow T>
  MessageWriter& rows(std::span<const T> values) {
    const std::size_t before = bytes_.size();
    bytes_.resize(before + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + before, values.data(), values.size_bytes());
    return *this;
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

// Reads bytes that may be anything. After the first value that is missing, every value is zero or empty and failed() is
// true: ask once at the end.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <MessageRow T>
  T get() {
    T value{};
    copy(&value, sizeof value);
    return value;
  }
  // Reads a text of at most `most` bytes.
  std::string text(std::size_t most) {
    const auto size = get<std::uint32_t>();
    if (size > most || size > left()) {
      failed_ = true;
      return {};
    }
    std::string value(size, '\0');
    copy(value.data(), size);
    return value;
  }
  // Allocates no memory for rows that are missing.
  template <MessageRow T>
  std::vector<T> rows(std::uint64_t count) {
    if (count > left() / sizeof(T)) failed_ = true;
    std::vector<T> values(failed_ ? 0 : static_cast<std::size_t>(count));
    copy(values.data(), values.size() * sizeof(T));
    return values;
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  [[nodiscard]] bool failed() const { return failed_; }
  // Everything was there, and nothing is left over.
  [[nodiscard]] bool is_read_whole() const { return !failed_ && bytes_.empty(); }

 private:
  void copy(void* to, std::size_t size) {
    if (failed_ || size > bytes_.size()) {
      failed_ = true;
      return;
    }
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace broadside::core
