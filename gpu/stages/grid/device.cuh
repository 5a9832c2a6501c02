// What stages need from CUDA beyond the language. gpu/on_host/device.hpp has the same for the host, where the threads
// of a kernel are fibers. So the stages can be run and tested without a GPU.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/grid_word.hpp"

#if defined(__CUDACC__)

#include <cuda/atomic>
#include <cuda/ptx>

namespace broadside::gpu {

// There is inline assembly in four places, where CUDA's C++ was measured to be slower; each place says by how much.

// A word that all blocks may read and write at any time.
template <typename T>
using GridAtomic = cuda::atomic_ref<T, cuda::thread_scope_device>;

// Called in each round of a loop that waits for another thread's write. Does nothing: sleeping for 32 ns makes a pile's
// contacts 5 % slower.
__device__ inline void relax() {}

// The barrier of one team of warps of a block; a block has at most 15 teams. Called by whole warps. CUDA's
// __barrier_sync_count cannot rely on warps being whole, and a search of vertices takes 3 % longer with it.
__device__ inline void sync_warps(std::uint32_t team, std::uint32_t warps) {
  asm volatile("bar.sync %0, %1;" ::"r"(team + 1), "r"(warps * 32) : "memory");
}

// Counts an arrival at *arrived and waits until there are `awaited`; orders memory over the grid. Called by one thread.
__device__ inline void arrive_and_wait(std::uint32_t* arrived, std::uint32_t awaited) {
  const GridAtomic<std::uint32_t> count(*arrived);
  count.fetch_add(1, cuda::memory_order_release);
  while (count.load(cuda::memory_order_acquire) < awaited) relax();
}

// A barrier for all blocks of a launch, which must be resident together. It counts on one word (grid_word.hpp) that is
// zero before the first launch and serves one launch at a time. A block loads the word when the launch begins, before
// any block can flip its highest bit. At the barrier it then only repeats one load until that bit differs. Arriving and
// waiting are inline assembly: by cuda::atomic_ref, which addresses memory generically, frames take 0.7 % longer.
class GridBarrier {
 public:
  __device__ explicit GridBarrier(unsigned long long* word) : word_(word) {
    if (threadIdx.x == 0) seen_ = GridAtomic<unsigned long long>(*word).load(cuda::memory_order_relaxed);
  }

  // Called by all threads. Waits for all blocks; what any thread wrote before is visible to all threads after.
  __device__ void sync() { arrive_and_wait_for_all(nullptr); }
  // The same in two parts. Between them a thread may do work whose results no other thread reads, and that reads
  // nothing of other threads.
  __device__ void arrive() {
    __syncthreads();
    if (threadIdx.x == 0) count_arrival();
  }
  __device__ void wait() {
    if (threadIdx.x == 0) wait_for_all();
    __syncthreads();
  }
  // As sync, and returns the tally. `in_block`: a word of the block's shared memory that nothing else uses.
  __device__ unsigned long long sync_and_read(unsigned long long* in_block) {
    arrive_and_wait_for_all(in_block);
    return *in_block;
  }

 private:
  __device__ __forceinline__ void arrive_and_wait_for_all(unsigned long long* tally) {
    __syncthreads();
    if (threadIdx.x == 0) {
      count_arrival();
      wait_for_all();
      if (tally != nullptr) *tally = seen_ & GridWord::kTally;
    }
    __syncthreads();
  }
  __device__ __forceinline__ void count_arrival() {
    const unsigned long long share = GridWord::share(blockIdx.x, gridDim.x);
    asm volatile("red.release.gpu.global.add.u64 [%0], %1;" ::"l"(word_), "l"(share) : "memory");
  }
  __device__ __forceinline__ void wait_for_all() {
    unsigned long long now = 0;
    do {
      asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(now) : "l"(word_) : "memory");
    } while (((now ^ seen_) & GridWord::kFlipped) == 0);
    seen_ = now;
  }

  unsigned long long* word_;
  unsigned long long seen_ = 0;
};

// The barrier of a launch that is one cluster of blocks, in two parts, as GridBarrier's. Compute capability 9 and
// later.
struct ClusterBarrier {
  __device__ static void arrive() {
    __syncwarp();
#if __CUDA_ARCH__ >= 900
    cuda::ptx::barrier_cluster_arrive(cuda::ptx::sem_release);
#endif
  }
  __device__ static void wait() {
#if __CUDA_ARCH__ >= 900
    cuda::ptx::barrier_cluster_wait(cuda::ptx::sem_acquire);
#endif
    __syncwarp();
  }
};

// The first lane of a whole warp adds to a word of global memory and gets what was there before; the other lanes get 0.
__device__ inline unsigned long long add_by_first_lane(unsigned long long* to, unsigned long long value) {
  return threadIdx.x % 32 == 0 ? atomicAdd(to, value) : 0;
}

// Counts an arrival at *arrived; orders memory over the grid. Returns how many there were before.
__device__ inline std::uint32_t arrive(std::uint32_t* arrived) {
  return GridAtomic<std::uint32_t>(*arrived).fetch_add(1, cuda::memory_order_acq_rel);
}

// Loads a word that other blocks may be writing, if `asks`; else returns 0. A predicated load, so that a thread waits
// where it uses the word: after a load inside an if it would wait at the end of the if, and a small grid frame takes
// 0.8 us longer.
__device__ inline std::uint32_t load_fresh_if(bool asks, const std::uint32_t* from) {
  std::uint32_t v = 0;
  asm volatile("{ .reg .pred asks; setp.ne.u32 asks, %2, 0; @asks ld.relaxed.gpu.global.u32 %0, [%1]; }"
               : "+r"(v)
               : "l"(from), "r"(asks ? 1U : 0U)
               : "memory");
  return v;
}

// Loads two words of 16 bytes, each in one access that is never torn. Each word is consistent in itself; the two may be
// of different moments. In global memory the loads bypass the multiprocessor's own cache.
struct GridWords {
  __device__ static void load_two_whole(const uint4* from, uint4 (&words)[2]) {
    for (int k = 0; k < 2; ++k) words[k] = load_whole(from + k);
  }
  // One such word.
  __device__ static void store_whole(uint4* to, uint4 v) {
    __nv_atomic_store(to, &v, __NV_ATOMIC_RELAXED, __NV_THREAD_SCOPE_DEVICE);
  }
  // Loads one such word, as it is at this moment.
  __device__ static uint4 load_whole(const uint4* from) {
    uint4 v;
    __nv_atomic_load(const_cast<uint4*>(from), &v, __NV_ATOMIC_RELAXED, __NV_THREAD_SCOPE_DEVICE);
    return v;
  }
  // Compare and swap: stores `v` if the word still equals `seen`, and sets `seen` to what the word was. Returns whether
  // it stored. The highest bit of the last 4 bytes is reserved: on GPUs that lack the instruction it locks the word.
  __device__ static bool replace_whole(uint4* at, uint4& seen, uint4 v) {
#if __CUDA_ARCH__ >= 900
    return __nv_atomic_compare_exchange(at, &seen, &v, false, __NV_ATOMIC_RELAXED, __NV_ATOMIC_RELAXED,
                                        __NV_THREAD_SCOPE_DEVICE);
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
};

// The same in the block's shared memory.
struct BlockWords {
  __device__ static void load_two_whole(const uint4* from, uint4 (&words)[2]) {
    for (int k = 0; k < 2; ++k)
      __nv_atomic_load(const_cast<uint4*>(from + k), &words[k], __NV_ATOMIC_RELAXED, __NV_THREAD_SCOPE_BLOCK);
  }
  __device__ static void store_whole(uint4* to, uint4 v) {
    __nv_atomic_store(to, &v, __NV_ATOMIC_RELAXED, __NV_THREAD_SCOPE_BLOCK);
  }
};

// Loads 16 bytes that are not needed again, so that they are the first to be evicted from the caches.
__device__ inline uint4 load_once(const uint4* from) {
  return __ldcs(from);
}

// A copy from global to shared memory, both aligned to 16 bytes. One warp begins it, and any thread of the block may
// wait for it. The object lies in shared memory and serves one copy a launch. A block must not end before its copy has
// ended.
class BlockCopy {
 public:
  // Called by one thread. A barrier of the block must follow before any other call.
  __device__ void init() {
#if __CUDA_ARCH__ >= 900
    cuda::ptx::mbarrier_init(reinterpret_cast<std::uint64_t*>(&done_), 1);
    cuda::ptx::fence_proxy_async(cuda::ptx::space_shared);
#else
    done_ = 0;
#endif
  }
  // Called by a whole warp. From compute capability 9 on, one thread starts one copy by the bulk copy engine.
  __device__ void begin(void* to, const void* from, std::uint32_t bytes) {
#if __CUDA_ARCH__ >= 900
    if (threadIdx.x % 32 == 0) {
      namespace ptx = cuda::ptx;
      auto* done = reinterpret_cast<std::uint64_t*>(&done_);
      ptx::mbarrier_arrive_expect_tx(ptx::sem_release, ptx::scope_cta, ptx::space_shared, done, bytes);
      ptx::cp_async_bulk(ptx::space_cluster, ptx::space_global, to, from, bytes, done);
    }
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

// For both signed halves of the words: max(0, min(a + b, most)).
__device__ inline std::uint32_t clamped_sums(std::uint32_t a, std::uint32_t b, std::uint32_t most) {
  return __viaddmin_s16x2_relu(a, b, most);
}

__device__ inline unsigned long long now_ns() {
  return cuda::ptx::get_sreg_globaltimer();
}

__device__ inline std::uint32_t warp_max(std::uint32_t value) {
#if __CUDA_ARCH__ >= 800
  return __reduce_max_sync(0xFFFFFFFFU, value);
#else
  for (unsigned step = 16; step > 0; step /= 2) value = max(value, __shfl_xor_sync(0xFFFFFFFFU, value, step));
  return value;
#endif
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
