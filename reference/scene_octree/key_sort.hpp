// Stable radix sort of 32-bit keys that carry 32-bit ids, on the calling thread.
#pragma once

#include <cstdint>
#include <span>

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

// Sorts by the lowest `key_bits` bits of the key, of which no higher bit is set. scratch: as many entries, at least.
void sort_by_key(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits);

}  // namespace broadside::reference
