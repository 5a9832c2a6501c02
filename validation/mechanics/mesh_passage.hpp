// How deep two meshes that are not convex can have been in each other within a step, by the arbiter of first touches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/exact/rigid_touch.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

class MeshPassage {
 public:
  explicit MeshPassage(const core::Scene& scene) : scene_(scene) {}

  // An upper bound of their depth at any time in this part of the step; 0 where they never touch. At the first touch
  // and at the last they only touch, so in between they are at most half as deep as they move from the one to the
  // other. moved_m: no two of their points come closer by more than this in this part.
  double deepest_m(const Motion& motion, core::Pair pair, std::size_t part, double moved_m);
  // How many pairs the arbiter was asked about: those whose swept boxes meet.
  [[nodiscard]] std::uint64_t asked() const { return asked_; }

 private:
  // Both about the center of mass.
  struct Shape {
    std::vector<core::Vec3> vertices;
    exact::MovingShape surface;
  };
  const Shape& shape(const Motion& motion, std::uint32_t body);

  const core::Scene& scene_;
  std::map<std::uint32_t, Shape> shapes_;  // by mesh
  std::uint64_t asked_ = 0;
};

}  // namespace broadside::validation
