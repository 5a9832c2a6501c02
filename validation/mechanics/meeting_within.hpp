// Whether two bodies can have met within a step of which only the ends are recorded: for engines that declare substeps,
// whose bodies may be struck and struck back in between.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact_point.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/mechanics/oriented_box.hpp"
#include "validation/mechanics/scene_friction.hpp"

namespace broadside::validation {

// Up to the first impulse between them, two bodies move with their velocities at the start, changed by gravity,
// wrenches and the impulses of other bodies. Those impulses are recorded as totals: the normal part only grows within a
// step, and friction may have had any direction, with at most its coefficient times that magnitude. So no point of a
// body was ever faster than the sum of these magnitudes over its mass, and, about its center, than their moments at its
// reach over its least moment of inertia.
class MeetingWithin {
 public:
  void read(const Motion& m, const core::Scene& scene, std::span<const core::ContactPoint> points) {
    scene_ = &scene;
    pushes_.assign(m.bodies.size(), 0.0);
    for (const core::ContactPoint& p : points) add(m, p, most_n_s(p), pushes_);
  }

  // How far the bodies' shapes can have approached each other before the first impulse between them, m. own: the points
  // between them.
  template <typename Points>
  [[nodiscard]] double way_m(const Motion& m, core::Pair pair, const Points& own) const {
    double given = 0.0;
    for (const core::ContactPoint& p : own) given += most_n_s(p);
    return way_of_m(m, pair.i, given) + way_of_m(m, pair.j, given);
  }

 private:
  [[nodiscard]] double most_n_s(const core::ContactPoint& p) const {
    const double mu = scene_friction(*scene_, p).larger();
    const double push = std::max(0.0, dot(Vec3d(p.impulse), Vec3d(p.normal)));
    return std::max(length(Vec3d(p.impulse)), std::sqrt(1.0 + mu * mu) * push);
  }

  static void add(const Motion& m, const core::ContactPoint& p, double push, std::vector<double>& to) {
    for (const std::uint32_t body : {p.a, p.b})
      if (!core::is_face(body) && m.facts[body].is_dynamic) to[body] += push;
  }

  // own: N s that the other body of the pair gave.
  [[nodiscard]] double way_of_m(const Motion& m, std::uint32_t body, double own) const {
    const BodyStep& b = m.bodies[body];
    const BodyFacts& f = m.facts[body];
    if (!f.is_dynamic) return 0.0;
    const double push = std::max(0.0, pushes_[body] - own);
    const double speed = length(b.before.v) + m.h * m.strongest_pull + push / f.mass_kg;
    const bool turns = f.has_inertia && m.turns;
    const double moment =
        length(b.before.angular_momentum) + m.h * (length(b.torque) + b.torque_slack) + push * f.reach_m;
    const double spin = turns ? moment / f.least_moment : length(b.before.w);
    // No point of the body moves farther than the center's way plus twice the body's reach.
    return m.h * speed + f.reach_m * std::min(2.0, m.h * spin);
  }

  const core::Scene* scene_ = nullptr;
  std::vector<double> pushes_;  // N s, by body
};

}  // namespace broadside::validation
