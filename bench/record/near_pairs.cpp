#include "bench/record/near_pairs.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>

#include "core/scene/shapes.hpp"

namespace broadside::bench {

NearPairs::NearPairs(const core::Scene& scene) {
  float theta_m = 0.0F;
  for (const core::Shape& shape : core::build_shapes(scene).shapes)
    theta_m = std::max(theta_m, core::pair_theta_m(scene.parameters, shape, shape));
  reach_m_ = theta_m;  // each box grows by theta on every side
  for (const core::Body& body : scene.bodies) is_static_.push_back(body.inverse_mass > 0.0F ? 0 : 1);
}

// Sort and sweep along x.
std::vector<core::Pair> NearPairs::of(const core::FrameRecord& frame) const {
  std::vector<core::Box> grown;
  for (const core::Box& b : frame.boxes) {
    const core::Vec3 reach{reach_m_, reach_m_, reach_m_};
    grown.push_back({b.min - reach, b.max + reach});
  }
  std::vector<std::uint32_t> order(grown.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto p, auto q) { return grown[p].min.x < grown[q].min.x; });
  std::vector<core::Pair> pairs = frame.confirmed;
  for (std::size_t p = 0; p < order.size(); ++p) {
    for (std::size_t q = p + 1; q < order.size() && grown[order[q]].min.x <= grown[order[p]].max.x; ++q) {
      if (is_static_[order[p]] != 0 && is_static_[order[q]] != 0) continue;
      if (core::overlaps(grown[order[p]], grown[order[q]])) pairs.push_back(core::make_pair_of(order[p], order[q]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::uint64_t separation_digest(const core::FrameRecord& frame) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < frame.measured.size(); ++k) {
    const core::Separation& s = frame.separations[k];
    sum += core::splitmix64(core::pair_key(frame.measured[k]) ^
                            core::splitmix64(std::bit_cast<std::uint64_t>(s.distance_m) + (s.is_touching ? 1U : 0U)));
  }
  return sum;
}

}  // namespace broadside::bench
