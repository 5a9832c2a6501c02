// Which pairs of bodies a narrow-phase engine is asked about.
#pragma once

#include <cstdint>
#include <vector>

#include "core/pair.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"

namespace broadside::bench {

// The pairs that the driver confirmed, and every pair whose boxes come within 2 theta of each other on all axes: a
// superset of the pairs whose surfaces are within 2 theta.
class NearPairs {
 public:
  explicit NearPairs(const core::Scene& scene);
  // frame: with its detection and confirmed groups.
  std::vector<core::Pair> of(const core::FrameRecord& frame) const;

 private:
  float reach_m_ = 0.0F;
  std::vector<std::uint8_t> is_static_;
};

// The sum modulo 2^64 of hashes of distance and flag over the measured pairs.
std::uint64_t separation_digest(const core::FrameRecord& frame);

}  // namespace broadside::bench
