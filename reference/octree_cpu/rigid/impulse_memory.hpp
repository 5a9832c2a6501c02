// The impulses of the last substep by pair of bodies and feature, with which the next step begins (warm start).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec3.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/pair.hpp"

namespace broadside::reference {

struct RememberedPoint {
  std::uint32_t feature = 0;
  float normal_n = 0.0F;  // N: an impulse per length of its substep, so that the step may change
  core::Vec3 friction_n;  // N on A, world axes
};

class ImpulseMemory {
 public:
  // The points of this pair; empty if it did not touch.
  [[nodiscard]] std::span<const RememberedPoint> of(std::uint32_t a, std::uint32_t b) const;
  void forget();
  // The place of the first patch of this pair.
  [[nodiscard]] std::uint32_t index_of(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool has_patch(std::uint32_t patch, std::uint32_t a, std::uint32_t b) const {
    return patch < pairs_.size() && pairs_[patch] == core::pair_key({a, b});
  }
  [[nodiscard]] std::span<const RememberedPoint> of_patch(std::uint32_t patch) const {
    return std::span(points_).subspan(4 * static_cast<std::size_t>(patch), 4);
  }

  // Replaces the memory: begin with the patches, sorted by (a, b), then keep for each of their points, in any order.
  void begin(std::span<const core::ContactPatch> patches);
  void keep(std::uint32_t patch, int point, const RememberedPoint& remembered) {
    points_[4 * static_cast<std::size_t>(patch) + static_cast<std::size_t>(point)] = remembered;
  }

 private:
  std::vector<std::uint64_t> pairs_;     // of the patches, sorted
  std::vector<RememberedPoint> points_;  // four a patch; feature 0 = none
};

}  // namespace broadside::reference
