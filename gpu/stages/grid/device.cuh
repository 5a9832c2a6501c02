// What stages need of CUDA beyond the language, in one place. gpu/on_host/device.hpp has the same for the host, where
// the threads of a kernel are fibers: so the stages run, and are tested, without a GPU.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/grid_word.hpp"

#if defined(__CUDACC__)

#include <cuda/ptx>

namespace broadside::gpu {

// Inline assembly stands where CUDA's C++ has no form with the same machine code: cuda::atomic_ref addresses memory
// generically and keeps results that nothing reads, which makes a barrier's arrival and wait longer; and predicated
// loads, whole words of 16 bytes and barriers of some warps of a block have no form at all.

// Called in each round of a loop that waits for another thread's write. Does nothing: sleeping for 32 ns makes a pile's
// contacts 5 % slower.
__device__ inline void relax() {}

// The barrier of one team of warps of a block, at most 15 teams a block. By whole warps.
__device__ inline void sync_warps(std::uint32_t team, std::uint32_t warps) {
  asm volatile("bar.sync %0, %1;" ::"r"(team + 1), "r"(warps * 32) : "memory");
}

// Counts an arrival at *arrived and waits until there are `awaited`; orders memory over the grid. By one thread.
__device__ inline void arrive_and_wait(std::uint32_t* arrived, std::uint32_t awaited) {
  asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(arrived) : "memory");
  std::uint32_t seen = 0;
  do {
    asm volatile("ld.acquire.gpu.global.u32 %0, [%1];" : "=r"(seen) : "l"(arrived) : "memory");
  } while (seen < awaited);
}

// A barrier for all blocks of a launch, which must be resident together. It counts on one word (grid_word.hpp) that is
// zero before the first launch and serves one launch at a time. A block loads the word when the launch begins, before
// any block can flip its highest bit; so at the barrier it waits for one load alone, until that bit differs.
class GridBarrier {
 public:
  __device__ explicit GridBarrier(unsigned long long* word) : word_(word) {
    if (threadIdx.x == 0) asm volatile("ld.relaxed.gpu.global.u64 %0, [%1];" : "=l"(seen_) : "l"(word) : "memory");
  }

  // Waits for all blocks; what any thread wrote before is visible to all threads after. By all threads.
  __device__ void sync() { arrive_and_wait_for_all(nullptr); }
  // The same, and returns the tally. `in_block`: in the block's shared memory, for this alone.
  __device__ unsigned long long sync_and_read(unsigned long long* in_block) {
    arrive_and_wait_for_all(in_block);
    return *in_block;
  }

 private:
  __device__ __forceinline__ void arrive_and_wait_for_all(unsigned long long* tally) {
    __syncthreads();
    if (threadIdx.x == 0) {
      const unsigned long long share = GridWord::share(blockIdx.x, gridDim.x);
      asm volatile("red.release.gpu.global.add.u64 [%0], %1;" ::"l"(word_), "l"(share) : "memory");
      unsigned long long now = 0;
      do {
        asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(now) : "l"(word_) : "memory");
      } while (((now ^ seen_) & GridWord::kFlipped) == 0);
      seen_ = now;
      if (tally != nullptr) *tally = now & GridWord::kTally;
    }
    __syncthreads();
  }

  unsigned long long* word_;
  unsigned long long seen_ = 0;
};

// Adds to a word of global memory by the first lane of a whole warp, and returns to it what was there. Predicated, as
// above: the warp waits where it uses the result.
__device__ inline unsigned long long add_by_first_lane(unsigned long long* to, unsigned long long value) {
  unsigned long long before = 0;
  asm volatile(
      "{ .reg .pred is_first; setp.eq.u32 is_first, %2, 0; @is_first atom.relaxed.gpu.global.add.u64 %0, [%1], %3; }"
      : "+l"(before)
      : "l"(to), "r"(threadIdx.x % 32), "l"(value)
      : "memory");
  return before;
}

// Counts an arrival at *arrived; orders memory over the grid. Returns how many there were before.
__device__ inline std::uint32_t arrive(std::uint32_t* arrived) {
  std::uint32_t before = 0;
  asm volatile("atom.acq_rel.gpu.global.add.u32 %0, [%1], 1;" : "=r"(before) : "l"(arrived) : "memory");
  return before;
}

// Loads a word that other blocks may be writing, for threads with `asks`; 0 for others. A predicated load, so that a
// thread waits where it uses the word: after a load inside an if, it would wait at the end of the if.
__device__ inline std::uint32_t load_fresh_if(bool asks, const std::uint32_t* from) {
  std::uint32_t v = 0;
  asm volatile("{ .reg .pred asks; setp.ne.u32 asks, %2, 0; @asks ld.relaxed.gpu.global.u32 %0, [%1]; }"
               : "+r"(v)
               : "l"(from), "r"(asks ? 1U : 0U)
               : "memory");
  return v;
}

// Two words of 16 bytes, loaded at once, each in one access that is never torn. Each is of one moment; both together
// need not be. In global memory the multiprocessor's own cache is bypassed.
struct GridWords {
  __device__ static void load_two_whole(const uint4* from, uint4 (&words)[2]) {
    unsigned long long part[4];
    asm volatile(
        "{ .reg .b128 s; .reg .b128 t; ld.relaxed.gpu.global.b128 s, [%4]; ld.relaxed.gpu.global.b128 t, [%4+16]; "
        "mov.b128 {%0, %1}, s; mov.b128 {%2, %3}, t; }"
        : "=l"(part[0]), "=l"(part[1]), "=l"(part[2]), "=l"(part[3])
        : "l"(from)
        : "memory");
    unpack(part, words);
  }
  // One such word.
  __device__ static void store_whole(uint4* to, uint4 v) {
    asm volatile("{ .reg .b128 t; mov.b128 t, {%1, %2}; st.relaxed.gpu.global.b128 [%0], t; }" ::"l"(to), "l"(low(v)),
                 "l"(high(v))
                 : "memory");
  }

  // One such word, of this moment.
  __device__ static uint4 load_whole(const uint4* from) {
    unsigned long long part[2];
    asm volatile("{ .reg .b128 s; ld.relaxed.gpu.global.b128 s, [%2]; mov.b128 {%0, %1}, s; }"
                 : "=l"(part[0]), "=l"(part[1])
                 : "l"(from)
                 : "memory");
    return unpacked(part[0], part[1]);
  }
  // Compare and swap: stores `v` if the word still is `seen`, which gets what the word was. Returns whether it stored.
  // The highest bit of the last 4 bytes is reserved: without such an instruction, it locks the word.
  __device__ static bool replace_whole(uint4* at, uint4& seen, uint4 v) {
#if __CUDA_ARCH__ >= 900
    const unsigned long long before[2] = {low(seen), high(seen)};
    unsigned long long now[2];
    asm volatile(
        "{ .reg .b128 s; .reg .b128 t; .reg .b128 u; mov.b128 s, {%3, %4}; mov.b128 t, {%5, %6};\n"
        "atom.relaxed.gpu.global.cas.b128 u, [%2], s, t; mov.b128 {%0, %1}, u; }"
        : "=l"(now[0]), "=l"(now[1])
        : "l"(at), "l"(before[0]), "l"(before[1]), "l"(low(v)), "l"(high(v))
        : "memory");
    seen = unpacked(now[0], now[1]);
    return now[0] == before[0] && now[1] == before[1];
#else
    constexpr unsigned kLock = 1U << 31;
    while ((atomicOr(&at->w, kLock) & kLock) != 0) relax();
    __threadfence();
    uint4 now = load_whole(at);
    now.w &= ~kLock;
    const bool is_same = now.x == seen.x && now.y == seen.y && now.z == seen.z && now.w == (seen.w & ~kLock);
    if (is_same) store_whole(at, {v.x, v.y, v.z, v.w | kLock});
    __threadfence();
    atomicAnd(&at->w, ~kLock);
    seen = now;
    return is_same;
#endif
  }

  __device__ static unsigned long long low(uint4 v) {
    return v.x | static_cast<unsigned long long>(v.y) << 32;
  }
  __device__ static unsigned long long high(uint4 v) {
    return v.z | static_cast<unsigned long long>(v.w) << 32;
  }
  __device__ static uint4 unpacked(unsigned long long low, unsigned long long high) {
    return {static_cast<unsigned>(low), static_cast<unsigned>(low >> 32), static_cast<unsigned>(high),
            static_cast<unsigned>(high >> 32)};
  }
  __device__ static void unpack(const unsigned long long (&part)[4], uint4 (&words)[2]) {
    for (int k = 0; k < 2; ++k) words[k] = unpacked(part[2 * k], part[2 * k + 1]);
  }
};

__device__ inline std::uint32_t in_shared(const void* p) {
  return static_cast<std::uint32_t>(__cvta_generic_to_shared(p));
}

// The same in the block's shared memory.
struct BlockWords {
  __device__ static void load_two_whole(const uint4* from, uint4 (&words)[2]) {
    unsigned long long part[4];
    asm volatile(
        "{ .reg .b128 s; .reg .b128 t; ld.relaxed.cta.shared.b128 s, [%4]; ld.relaxed.cta.shared.b128 t, [%4+16]; "
        "mov.b128 {%0, %1}, s; mov.b128 {%2, %3}, t; }"
        : "=l"(part[0]), "=l"(part[1]), "=l"(part[2]), "=l"(part[3])
        : "r"(in_shared(from))
        : "memory");
    GridWords::unpack(part, words);
  }
  __device__ static void store_whole(uint4* to, uint4 v) {
    asm volatile("{ .reg .b128 t; mov.b128 t, {%1, %2}; st.relaxed.cta.shared.b128 [%0], t; }" ::"r"(in_shared(to)),
                 "l"(GridWords::low(v)), "l"(GridWords::high(v))
                 : "memory");
  }
};

// Loads 16 bytes that are not needed again: the first to leave the caches.
__device__ inline uint4 load_once(const uint4* from) {
  return __ldcs(from);
}

// A copy from global to shared memory, both aligned to 16 bytes. One warp begins it, any thread of the block may wait
// for it. Lies in shared memory; for one copy a launch. A block must not end before its copy has.
class BlockCopy {
 public:
  // By one thread. A barrier of the block must follow before any other call.
  __device__ void init() {
#if __CUDA_ARCH__ >= 900
    cuda::ptx::mbarrier_init(reinterpret_cast<std::uint64_t*>(&done_), 1);
    cuda::ptx::fence_proxy_async(cuda::ptx::space_shared);
#else
    done_ = 0;
#endif
  }
  // By a whole warp. With compute capability 9, one thread starts one copy of the bulk copy engine.
  __device__ void begin(void* to, const void* from, std::uint32_t bytes) {
#if __CUDA_ARCH__ >= 900
    if (threadIdx.x % 32 == 0)
      asm volatile(
          "{ .reg .b64 state;\n"
          "mbarrier.arrive.expect_tx.shared.b64 state, [%0], %3;\n"
          "cp.async.bulk.shared::cluster.global.mbarrier::complete_tx::bytes [%1], [%2], %3, [%0]; }" ::"r"(
              in_shared(&done_)),
          "r"(in_shared(to)), "l"(from), "r"(bytes)
          : "memory");
#else
    for (std::uint32_t w = threadIdx.x % 32; w < bytes / sizeof(uint4); w += 32)
      static_cast<uint4*>(to)[w] = static_cast<const uint4*>(from)[w];
    __threadfence_block();
    __syncwarp();
    if (threadIdx.x % 32 == 0) *static_cast<volatile unsigned long long*>(&done_) = 1;
#endif
  }
  __device__ void wait() const {
#if __CUDA_ARCH__ >= 900
    auto* done = reinterpret_cast<std::uint64_t*>(const_cast<unsigned long long*>(&done_));
    while (!cuda::ptx::mbarrier_try_wait_parity(done, 0)) {
    }
#else
    while (*static_cast<const volatile unsigned long long*>(&done_) == 0) relax();
    __threadfence_block();
#endif
  }

 private:
  unsigned long long done_;
};

// The largest integer not above v; saturates.
__device__ inline int floor_to_int(float v) {
  return __float2int_rd(v);
}

// Two signed halves at once: max(0, min(a + b, most)).
__device__ inline std::uint32_t clamped_sums(std::uint32_t a, std::uint32_t b, std::uint32_t most) {
  return __viaddmin_s16x2_relu(a, b, most);
}

__device__ inline unsigned long long now_ns() {
  return cuda::ptx::get_sreg_globaltimer();
}

__device__ inline std::uint32_t warp_min(std::uint32_t value) {
#if __CUDA_ARCH__ >= 800
  return __reduce_min_sync(0xFFFFFFFFU, value);
#else
  for (unsigned step = 16; step > 0; step /= 2) value = min(value, __shfl_xor_sync(0xFFFFFFFFU, value, step));
  return value;
#endif
}

}  // namespace broadside::gpu

#else

#include "gpu/on_host/device.hpp"

#endif
