// A constant force and torque on one body, for scenes whose outcome has a closed form.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"

namespace broadside::core {

// In which axes a wrench is constant.
enum class WrenchAxes : std::uint32_t { kWorld = 0, kBody = 1 };

// Acts in every step, besides gravity. The force acts at the body's center of mass. A body may have several wrenches:
// they add.
struct Wrench {
  std::uint32_t body = 0;
  WrenchAxes axes = WrenchAxes::kWorld;
  Vec3 force_n;
  Vec3 torque_n_m;

  friend constexpr bool operator==(const Wrench&, const Wrench&) = default;
};

}  // namespace broadside::core
