// The cube root with the same bits on every platform.
#pragma once

#include <algorithm>

namespace broadside::datasets {

// Newton's method from above decreases until rounding stops it. std::cbrt is not used because libraries differ in its
// last bit, and a scene must be the same everywhere. 0 for v <= 0.
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
