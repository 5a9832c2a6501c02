// The one host/device attribute. Every formula of the method is written once and compiled for both.
#pragma once

#if defined(__CUDACC__)
#define BROADSIDE_HD __host__ __device__ __forceinline__
#else
#define BROADSIDE_HD inline
#endif
