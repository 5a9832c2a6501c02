// How far bodies can have gone within a step: for laws about points that were found within it, and are recorded at the
// pose of its start (detection_at = within).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact_point.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

// Whether points of this frame may have been found within the step: not where the trace says that the step was taken at
// once.
inline bool finds_within(const core::TraceHeader& header, const core::FrameRecord& frame) {
  return frame.parts != 1 && header.declaration.text("detection_at") == "within";
}

// At every moment of the step a body's speed is at most its speed at the start plus what gravity and the magnitudes of
// all impulses on it add. Its angular momentum is at most that at the start plus the magnitudes of all moments; the
// spin is largest if this is about the axis of the least moment of inertia.
class WaysWithin {
 public:
  void read(const Motion& m, std::span<const core::ContactPoint> points) {
    ways_.assign(m.bodies.size(), {});
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const BodyState& s = m.bodies[i].before;
      const bool is_moved = m.facts[i].is_dynamic;
      ways_[i].speed = length(s.v) + (is_moved ? m.h * m.strongest_pull : 0.0);
      ways_[i].spin = is_turned(m, i) ? length(s.angular_momentum) / m.facts[i].least_moment : length(s.w);
    }
    for (const core::ContactPoint& p : points) {
      add(m, p, p.a);
      add(m, p, p.b);
    }
    h_ = m.h;
  }

  // No point of the body at most this far from its center of mass moves farther, m; 0 for faces.
  [[nodiscard]] double way_m(std::uint32_t body, double arm_m) const {
    return core::is_face(body) ? 0.0 : h_ * (ways_[body].speed + ways_[body].spin * arm_m);
  }

  // By how much the speed of such a point about the center may differ, m/s, because its arm is not the recorded one.
  [[nodiscard]] double speed_m_s(std::uint32_t body, double arm_m) const {
    return core::is_face(body) ? 0.0 : ways_[body].spin * way_m(body, arm_m);
  }

 private:
  struct Way {
    double speed = 0.0;  // m/s
    double spin = 0.0;   // rad/s
  };

  static bool is_turned(const Motion& m, std::size_t body) {
    return m.facts[body].is_dynamic && m.facts[body].has_inertia && m.turns;
  }

  void add(const Motion& m, const core::ContactPoint& p, std::uint32_t body) {
    if (core::is_face(body) || !m.facts[body].is_dynamic) return;
    const Vec3d j(p.impulse);
    ways_[body].speed += length(j) / m.facts[body].mass_kg;
    if (is_turned(m, body))
      ways_[body].spin += length(cross(Vec3d(p.point) - m.bodies[body].before.x, j)) / m.facts[body].least_moment;
  }

  std::vector<Way> ways_;
  double h_ = 0.0;
};

}  // namespace broadside::validation
