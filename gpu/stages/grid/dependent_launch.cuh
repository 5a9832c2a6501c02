// Launches that begin while the launch before them ends: CUDA's programmatic dependent launch, which small frames use.
//
// Blocks of a frame wait for each other at barriers, so all of them must become resident, or the frame never ends. CUDA
// guarantees that for cooperative launches, but a cooperative launch cannot be a dependent one. For dependent launches
// it follows from four facts:
//
// 1. A launch has no more blocks than are resident at once on an empty GPU (LaunchShape::blocks, from the occupancy).
// 2. All launches of this kind of a process are in one stream (frame_stream). So the next one begins only when every
//    block of this one has called let_next_launch_begin() or has ended: all of them are resident by then.
// 3. Whatever else occupies the GPU ends without waiting for these blocks: other kernels of this process have no
//    barriers with them, and blocks of the launch before end once all blocks of that launch are resident.
// 4. Other processes take turns with this one in time. Under MPS they do not, so launches are cooperative there.
#pragma once

#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

#if defined(__CUDACC__)

// Waits until the launch before this one in the stream has ended and its writes are visible. Before this call a thread
// may read only what no launch writes, and may write nothing. Returns at once in a launch that is not dependent.
__device__ inline void wait_for_launch_before() {
#if __CUDA_ARCH__ >= 900
  cudaGridDependencySynchronize();
#endif
}

// Called by all blocks: from now on the next launch in the stream may begin, as far as its blocks find room.
__device__ inline void let_next_launch_begin() {
#if __CUDA_ARCH__ >= 900
  cudaTriggerProgrammaticLaunchCompletion();
#endif
}

// Whether `kernel` may be launched as a dependent launch. It must have the instruction that waits for the launch
// before. Code that was compiled for an older GPU, and translated by the driver, may lack it.
inline bool can_be_dependent(const void* kernel) {
  int device = 0;
  int shares_gpu = 0;
  cudaFuncAttributes code = {};
  return cudaGetDevice(&device) == cudaSuccess &&
         cudaDeviceGetAttribute(&shares_gpu, cudaDevAttrMpsEnabled, device) == cudaSuccess && shares_gpu == 0 &&
         cudaFuncGetAttributes(&code, kernel) == cudaSuccess && code.ptxVersion >= 90;
}

#else

// On the host, launches follow each other.
inline void wait_for_launch_before() {}
inline void let_next_launch_begin() {}

#endif

}  // namespace broadside::gpu
