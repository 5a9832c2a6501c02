// Keeps the compiler from unrolling a loop. On a GPU, warps at different places of long code wait for its instructions
// to be fetched; as a loop, the same code is a fraction of the size.
#pragma once

#if defined(__CUDACC__)
#define BROADSIDE_KEPT_LOOP _Pragma("unroll 1")
#else
#define BROADSIDE_KEPT_LOOP
#endif
