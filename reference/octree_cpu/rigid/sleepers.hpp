// Which bodies sleep: core/method/rigid/sleep.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec3.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::reference {

// The result is a function of the states and patches that the calls pass in, not of the order in which bodies came to
// touch.
class Sleepers {
 public:
  // Wakes all bodies.
  void load(const core::RigidBodies& bodies);
  void wake_all();

  // By body: 1 = asleep. Static bodies never are.
  [[nodiscard]] std::span<const std::uint8_t> asleep() const { return asleep_; }
  [[nodiscard]] bool is_anybody_asleep() const { return count_ > 0; }
  // Bodies asleep, summed over the steps since load.
  [[nodiscard]] std::uint64_t steps_slept() const { return steps_slept_; }

  // Call before the response. Wakes each island that a patch of an awake body touches. Returns whether one woke.
  bool wake_touched(std::span<const core::ContactPatch> patches);
  // Call after the response. Puts to sleep, and stops, each island whose bodies have all been still for long enough;
  // patches connect bodies to islands.
  void fall_asleep(core::RigidBodies& bodies, std::span<const core::ContactPatch> patches, core::Vec3 gravity_m_s2,
                   float dt_s);

 private:
  [[nodiscard]] std::uint32_t root(std::uint32_t body);

  std::vector<std::uint8_t> asleep_;
  std::vector<std::uint8_t> is_static_;
  std::vector<std::uint32_t> still_;   // steps in a row
  std::vector<std::uint32_t> island_;  // of a sleeping body: the lowest body of its island
  std::vector<std::uint32_t> parent_;  // while islands are found
  std::vector<std::uint8_t> is_restless_;
  std::uint32_t count_ = 0;
  std::uint64_t steps_slept_ = 0;
};

}  // namespace broadside::reference
