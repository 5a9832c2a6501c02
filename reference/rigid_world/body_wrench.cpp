#include "reference/rigid_world/body_wrench.hpp"

namespace broadside::reference {

using plain::Vec;

bool BodyWrench::is_none() const {
  const auto is_zero = [](Vec v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; };
  return is_zero(force_world) && is_zero(force_body) && is_zero(torque_world) && is_zero(torque_body);
}

BodyWrench wrench_on(const core::Scene& scene, std::uint32_t body) {
  BodyWrench sum;
  for (const core::Wrench& w : scene.wrenches) {
    if (w.body != body) continue;
    const bool turns = w.axes == core::WrenchAxes::kBody;
    Vec& force = turns ? sum.force_body : sum.force_world;
    Vec& torque = turns ? sum.torque_body : sum.torque_world;
    force = force + Vec{w.force_n.x, w.force_n.y, w.force_n.z};
    torque = torque + Vec{w.torque_n_m.x, w.torque_n_m.y, w.torque_n_m.z};
  }
  return sum;
}

}  // namespace broadside::reference
