// A loop that the compiler shall not unroll. On a GPU, warps that are at different places of long code wait for its
// instructions; the same code in a loop is a fraction of it.
#pragma once

#if defined(__CUDACC__)
#define BROADSIDE_KEPT_LOOP _Pragma("unroll 1")
#else
#define BROADSIDE_KEPT_LOOP
#endif
