// Stable radix sort of 32-bit keys that carry 32-bit ids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace broadside::reference {

// Key above id.
using KeyedId = std::uint64_t;

constexpr KeyedId keyed_id(std::uint32_t key, std::uint32_t id) {
  return static_cast<KeyedId>(key) << 32U | id;
}
constexpr std::uint32_t key_of(KeyedId entry) {
  return static_cast<std::uint32_t>(entry >> 32U);
}
constexpr std::uint32_t id_of(KeyedId entry) {
  return static_cast<std::uint32_t>(entry);
}

// Sorts by the lowest `key_bits` bits of the key, on the workers of the current arena. scratch: as many entries.
class KeySort {
 public:
  void sort(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits);

 private:
  std::vector<std::uint32_t> counts_;
};

// The same on the calling thread alone.
void sort_alone(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits);

}  // namespace broadside::reference
