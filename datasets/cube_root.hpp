// The cube root with the same bits on every platform.
#pragma once

#include <algorithm>

namespace broadside::datasets {

// Newton's method from above falls until rounding stops it. std::cbrt differs between libraries in the last bit, and a
// scene must be the same scene everywhere. 0 for v <= 0.
inline double cube_root(double v) {
  if (!(v > 0.0)) return 0.0;
  double r = std::max(v, 1.0);
  for (;;) {
    const double next = r - (r - v / (r * r)) / 3.0;
    if (!(next < r)) return r;
    r = next;
  }
}

}  // namespace broadside::datasets
