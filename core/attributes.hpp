// The one host/device attribute. Every formula of the method is written once and compiled for both.
#pragma once

#if defined(__CUDACC__)
#define BROADSIDE_HD __host__ __device__ __forceinline__
// For a large function that is called from several places: not inlined, so that its code exists once.
#define BROADSIDE_HD_CALLED __host__ __device__ inline __noinline__
#else
#define BROADSIDE_HD inline
#define BROADSIDE_HD_CALLED inline
#endif
