// Parts of a recording of plain-rigid that a tampering changes.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "bench/mutants/rigid_tamperings.hpp"
#include "core/contact.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::bench {

using core::ContactPoint;
using core::FrameRecord;
using core::Vec3;
using core::WideQuat;
using core::WideVec3;

// Sets the body's float32 states to its float64 states, rounded.
inline void narrow(FrameRecord& frame, std::size_t body) {
  frame.position[body] = core::narrowed(frame.wide.position[body]);
  frame.orientation[body] = core::narrowed(frame.wide.orientation[body]);
  frame.velocity[body] = core::narrowed(frame.wide.velocity[body]);
  frame.angular_velocity[body] = core::narrowed(frame.wide.angular_velocity[body]);
}

// change(FrameRecord&) at the steps first to last.
template <typename Change>
void in_frames(Specimen& r, std::uint64_t first, std::uint64_t last, const Change& change) {
  for (FrameRecord& frame : r.frames) {
    if (frame.step < first || frame.step > last) continue;
    change(frame);
    for (std::size_t i = 0; i < frame.position.size(); ++i) narrow(frame, i);
  }
}
template <typename Change>
void at_step(Specimen& r, std::uint64_t step, const Change& change) {
  in_frames(r, step, step, change);
}
constexpr std::uint64_t kToTheEnd = ~std::uint64_t{0};

// Turns by a small angle (rad) about the vertical.
inline WideQuat turned(const WideQuat& q, double angle) {
  const double c = std::cos(0.5 * angle);
  const double s = std::sin(0.5 * angle);
  return {c * q.w - s * q.y, c * q.x + s * q.z, c * q.y + s * q.w, c * q.z - s * q.x};
}

inline double size_of(Vec3 v) {
  return std::sqrt(double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z);
}
inline Vec3 along_normal(const ContactPoint& p) {
  return dot(p.impulse, p.normal) * p.normal;
}
inline Vec3 across_normal(const ContactPoint& p) {
  return p.impulse - along_normal(p);
}
inline bool carries(const ContactPoint& p) {
  return size_of(p.impulse) > 1e-4;
}
inline bool is_on_floor(const ContactPoint& p) {
  return core::is_face(p.b) && carries(p);
}
inline bool is_between_bodies(const ContactPoint& p) {
  return !core::is_face(p.b) && carries(p);
}
inline bool is_braked(const ContactPoint& p) {
  return size_of(across_normal(p)) > 0.1 * size_of(p.impulse);
}

// change(ContactPoint&) at every point that fits.
template <typename Fits, typename Change>
void at_points(Specimen& r, const Fits& fits, const Change& change) {
  bool is_any = false;
  for (FrameRecord& frame : r.frames)
    for (ContactPoint& p : frame.points)
      if (fits(p)) change(p), is_any = true;
  if (!is_any) r.is_spoilable = false;
}

// Replaces these keys of the engine's declaration. A key that it does not know ends the program.
inline void declare(Specimen& r, const std::map<std::string, std::string>& lies) {
  std::map<std::string, std::string> all(r.header.declaration.declared().begin(),
                                         r.header.declaration.declared().end());
  for (const auto& [key, value] : lies) all[key] = value;
  r.header.declaration = core::Declaration::of(all);
}

}  // namespace broadside::bench
