// The part of CUDA's device language that the stages use, for the host's compiler. The threads of a kernel are fibers
// of one OS thread (fibers.hpp), and every barrier, vote and shuffle waits for all fibers that take part. This is slow
// and strict: if a fiber never comes, the deadlock is reported, and a seed shuffles the order in which fibers run.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "gpu/on_host/fibers.hpp"
#include "gpu/stages/grid/grid_word.hpp"

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming): the names are CUDA's
// The two function attributes that stages are written with.
#define __device__
#define __forceinline__ inline

struct alignas(16) uint4 {
  unsigned x;
  unsigned y;
  unsigned z;
  unsigned w;
};

struct alignas(8) uint2 {
  unsigned x;
  unsigned y;
};

namespace broadside::gpu {

using std::max;
using std::min;

// These have CUDA's names; each gives the value of the running fiber.
#define threadIdx (::broadside::gpu::on_host::self().thread)
#define blockIdx (::broadside::gpu::on_host::self().block)
#define blockDim (::broadside::gpu::on_host::launch().block_size)
#define gridDim (::broadside::gpu::on_host::launch().grid_size)

inline void relax() {
  on_host::yield();
}
class GridBarrier {
 public:
  explicit GridBarrier(unsigned long long* word) : word_(word) {}
  void sync() {
    if (threadIdx.x == 0) *word_ += GridWord::share(blockIdx.x, gridDim.x);
    on_host::sync_grid();
  }
  // Between arrive() and wait() a thread needs nothing from other threads, so arrive() may do nothing and wait() is the
  // whole barrier.
  void arrive() {}
  void wait() { sync(); }
  unsigned long long sync_and_read(unsigned long long* /*in_block*/) {
    sync();
    const unsigned long long tally = *word_ & GridWord::kTally;
    // No fiber goes on to change the word before all have read it.
    on_host::sync_grid();
    return tally;
  }

 private:
  unsigned long long* word_;
};
struct ClusterBarrier {
  static void arrive() {}
  static void wait() { on_host::sync_grid(); }
};
inline void __syncthreads() {
  on_host::sync_block(false);
}
// Blocks have two warps, so a team of more than one warp is the block.
inline void sync_warps(std::uint32_t /*team*/, std::uint32_t /*warps*/) {
  on_host::sync_block(false);
}
inline int __syncthreads_or(int value) {
  return on_host::sync_block(value != 0) ? 1 : 0;
}
inline void __syncwarp() {
  on_host::exchange(0);
}
inline void __threadfence_block() {}
inline void __threadfence() {}

template <typename T>
T on_host_shuffle(T value, unsigned lane) {
  static_assert(sizeof(T) <= sizeof(std::uint64_t));
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  const std::uint64_t* all = on_host::exchange(bits);
  T out;
  std::memcpy(&out, &all[lane % 32], sizeof out);
  return out;
}

template <typename T>
T __shfl_sync(unsigned, T value, unsigned from) {
  return on_host_shuffle(value, from);
}
template <typename T>
T __shfl_up_sync(unsigned, T value, unsigned step) {
  const unsigned own = threadIdx.x % 32;
  return on_host_shuffle(value, own >= step ? own - step : own);
}
template <typename T>
T __shfl_xor_sync(unsigned, T value, unsigned step) {
  return on_host_shuffle(value, (threadIdx.x % 32) ^ step);
}
inline unsigned __ballot_sync(unsigned, bool value) {
  const std::uint64_t* all = on_host::exchange(value ? 1 : 0);
  unsigned bits = 0;
  for (unsigned k = 0; k < 32; ++k) bits |= static_cast<unsigned>(all[k]) << k;
  return bits;
}
inline bool __any_sync(unsigned mask, bool value) {
  return __ballot_sync(mask, value) != 0;
}
// Fibers never run at the same time.
inline unsigned __activemask() {
  return 1U << (threadIdx.x % 32);
}
inline std::uint32_t warp_max(std::uint32_t value) {
  const std::uint64_t* all = on_host::exchange(value);
  return static_cast<std::uint32_t>(*std::max_element(all, all + 32));
}
inline std::uint32_t warp_min(std::uint32_t value) {
  const std::uint64_t* all = on_host::exchange(value);
  return static_cast<std::uint32_t>(*std::min_element(all, all + 32));
}

template <typename T>
T atomicAdd(T* to, T value) {
  const T old = *to;
  *to = old + value;
  return old;
}
template <typename T>
T atomicMin(T* to, T value) {
  const T old = *to;
  *to = std::min(old, value);
  return old;
}
template <typename T>
T atomicCAS(T* at, T seen, T value) {
  const T before = *at;
  if (before == seen) *at = value;
  return before;
}
template <typename T>
T atomicMax(T* to, T value) {
  const T old = *to;
  *to = std::max(old, value);
  return old;
}
template <typename T>
T atomicOr(T* to, T value) {
  const T old = *to;
  *to = old | value;
  return old;
}

inline unsigned long long add_by_first_lane(unsigned long long* to, unsigned long long value) {
  return threadIdx.x % 32 == 0 ? atomicAdd(to, value) : 0;
}

inline int __popcll(unsigned long long v) {
  return std::popcount(v);
}
inline int __popc(unsigned v) {
  return std::popcount(v);
}
inline int __ffs(unsigned v) {
  return v == 0 ? 0 : std::countr_zero(v) + 1;
}
inline int __ffsll(long long v) {
  return v == 0 ? 0 : std::countr_zero(static_cast<unsigned long long>(v)) + 1;
}
inline int __clz(unsigned v) {
  return std::countl_zero(v);
}
inline int floor_to_int(float v) {
  return static_cast<int>(std::clamp(std::floor(static_cast<double>(v)), -2147483648.0, 2147483647.0));
}
inline std::uint32_t clamped_sums(std::uint32_t a, std::uint32_t b, std::uint32_t most) {
  const auto half = [](std::uint32_t word, unsigned by) { return static_cast<std::int16_t>(word >> by); };
  const auto clamped = [&](unsigned by) {
    const auto sum = static_cast<std::int16_t>(half(a, by) + half(b, by));
    return static_cast<std::uint32_t>(max<std::int16_t>(0, min(sum, half(most, by))));
  };
  return clamped(0) | clamped(16) << 16U;
}
inline float __uint_as_float(unsigned v) {
  return std::bit_cast<float>(v);
}
inline unsigned __float_as_uint(float v) {
  return std::bit_cast<unsigned>(v);
}

inline std::uint32_t load_fresh_if(bool asks, const std::uint32_t* from) {
  return asks ? *from : 0U;
}
inline std::uint32_t arrive(std::uint32_t* arrived) {
  return (*arrived)++;
}
inline void arrive_and_wait(std::uint32_t* arrived, std::uint32_t awaited) {
  ++*arrived;
  while (*static_cast<volatile std::uint32_t*>(arrived) < awaited) on_host::yield();
}
inline uint4 load_once(const uint4* from) {
  return *from;
}
struct GridWords {
  static void load_two_whole(const uint4* from, uint4 (&words)[2]) {
    words[0] = from[0];
    words[1] = from[1];
  }
  static void store_whole(uint4* to, uint4 v) { *to = v; }
  static uint4 load_whole(const uint4* from) { return *from; }
  static bool replace_whole(uint4* at, uint4& seen, uint4 v) {
    const uint4 before = seen;
    seen = *at;
    if (std::memcmp(&before, &seen, sizeof seen) != 0) return false;
    *at = v;
    return true;
  }
};
using BlockWords = GridWords;
class BlockCopy {
 public:
  void init() { is_there_ = false; }
  void begin(void* to, const void* from, std::uint32_t bytes) {
    if (threadIdx.x % 32 != 0) return;
    std::memcpy(to, from, bytes);
    is_there_ = true;
  }
  void wait() const {
    while (!is_there_) on_host::yield();
  }

 private:
  volatile bool is_there_;
};
inline unsigned long long now_ns() {
  return on_host::now_ns();
}

}  // namespace broadside::gpu
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
