// Stores and loads a contact in global memory by words of 16 bytes: nine accesses instead of thirty-six.
#pragma once

#include <cstring>

#include "core/contact.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

constexpr std::size_t kContactWords = sizeof(core::Contact) / sizeof(uint4);
static_assert(kContactWords * sizeof(uint4) == sizeof(core::Contact));

__device__ inline void store_contact(core::Contact* to, const core::Contact& contact) {
  uint4 words[kContactWords];
  memcpy(words, &contact, sizeof contact);
#pragma unroll
  for (std::size_t w = 0; w < kContactWords; ++w) reinterpret_cast<uint4*>(to)[w] = words[w];
}

// For contacts that are read once: they are the first to be evicted from the cache, so that these loads do not evict
// what the frame left there and is still to be read.
__device__ inline core::Contact load_contact_once(const core::Contact* from) {
  uint4 words[kContactWords];
#pragma unroll
  for (std::size_t w = 0; w < kContactWords; ++w) words[w] = load_once(reinterpret_cast<const uint4*>(from) + w);
  core::Contact contact;
  memcpy(&contact, words, sizeof contact);
  return contact;
}

}  // namespace broadside::gpu
