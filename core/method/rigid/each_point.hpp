// Loops over the points of a patch, core::PatchOf.
#pragma once

#include "core/attributes.hpp"
#include "core/method/rigid/manifold.hpp"

namespace broadside::core {

// work(k) for every point. The length is fixed, so that a GPU's compiler unrolls the loop and keeps points in
// registers.
template <typename Patch, typename Work>
BROADSIDE_HD void each_point(const Patch& c, const Work& work) {
#if defined(__CUDACC__)
#pragma unroll
#endif
  for (int k = 0; k < kManifoldPoints; ++k)
    if (k < c.count) work(k);
}

// The same from the last one to the first.
template <typename Patch, typename Work>
BROADSIDE_HD void each_point_back(const Patch& c, const Work& work) {
#if defined(__CUDACC__)
#pragma unroll
#endif
  for (int k = kManifoldPoints - 1; k >= 0; --k)
    if (k < c.count) work(k);
}

// The same, but on a GPU also for points that the patch does not have, without a branch. All their numbers are zeros,
// so they add zeros: that changes no bit of a sum that is not -0.
template <typename Patch, typename Work>
BROADSIDE_HD void each_point_or_zeros(const Patch& c, const Work& work) {
#if defined(__CUDACC__)
  (void)c;
#pragma unroll
  for (int k = 0; k < kManifoldPoints; ++k) work(k);
#else
  each_point(c, work);
#endif
}

// Whether to skip work that no lane needs. On a GPU a branch costs more than the work that it would skip.
BROADSIDE_HD constexpr bool is_left_out(bool needs_none) {
#if defined(__CUDACC__)
  (void)needs_none;
  return false;
#else
  return needs_none;
#endif
}

}  // namespace broadside::core
