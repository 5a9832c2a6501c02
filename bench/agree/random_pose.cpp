#include "bench/agree/random_pose.hpp"

#include <array>
#include <cmath>

namespace broadside::bench {

core::Vec3 to_core(exact::Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

core::Quat random_orientation(datasets::RandomStream& random) {
  for (;;) {
    std::array<double, 4> q;
    double squared = 0.0;
    for (double& c : q) {
      c = random.between(-1.0, 1.0);
      squared += c * c;
    }
    if (squared > 1.0 || squared < 1e-4) continue;
    const double r = std::sqrt(squared);
    return {static_cast<float>(q[0] / r), static_cast<float>(q[1] / r), static_cast<float>(q[2] / r),
            static_cast<float>(q[3] / r)};
  }
}

}  // namespace broadside::bench
