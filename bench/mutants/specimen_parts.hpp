// Parts of a specimen that a tampering changes: the first contact, pair or vertex pair of a kind. When there is none,
// the specimen notes it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "bench/mutants/tamperings.hpp"
#include "core/contact.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"

namespace broadside::bench {

using core::Contact;
using core::FrameRecord;
using core::Pair;
using core::Vec3;

inline constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

// The first contact that fits.
template <typename Fits>
Contact& contact_that(Specimen& specimen, Fits fits) {
  for (FrameRecord& frame : specimen.frames)
    for (Contact& c : frame.contacts)
      if (fits(c)) return c;
  specimen.is_spoilable = false;
  return specimen.frames.front().contacts.emplace_back();
}

inline bool is_shared(const Contact& c) {
  return !core::is_face(c.b) && c.a != 2 && c.b != 2;
}
inline bool is_bounce(const Contact& c) {
  return c.normal_impulse_n_s > 0.5F;
}
inline bool is_separating(const Contact& c) {
  return c.normal_impulse_n_s == 0.0F;
}
inline bool is_deep(const Contact& c) {
  return c.depth_m > 0.02F;
}
inline bool is_in_slop(const Contact& c) {
  return c.depth_m < 0.009F;
}
inline bool is_on_face(const Contact& c) {
  return core::is_face(c.b);
}
// Against something static, in the kinetic regime: |J_t| < mu_s J_n strictly.
inline bool is_slide(const Contact& c) {
  return c.tangent_impulse_n_s < 0.0F && std::abs(c.tangent_impulse_n_s / c.normal_impulse_n_s + 0.5F) < 1e-4F;
}
inline bool is_stick(const Contact& c) {
  return c.tangent_impulse_n_s < -1e-3F && -c.tangent_impulse_n_s < 0.49F * c.normal_impulse_n_s;
}

inline FrameRecord& frame_with_pairs(Specimen& specimen) {
  for (FrameRecord& frame : specimen.frames)
    if (!frame.pairs.empty()) return frame;
  specimen.is_spoilable = false;
  return specimen.frames.front();
}

// A touching pair and its proximity.
struct Touch {
  FrameRecord* frame;
  Pair pair;
  core::Proximity* proximity;
};

inline Touch touch_of(Specimen& specimen) {
  for (FrameRecord& frame : specimen.frames)
    for (std::size_t k = 0; k < frame.confirmed.size(); ++k)
      if (frame.proximity[k].is_touching()) return {&frame, frame.confirmed[k], &frame.proximity[k]};
  specimen.is_spoilable = false;
  specimen.frames.front().confirmed.push_back({0, 1});
  return {&specimen.frames.front(), {0, 1}, &specimen.frames.front().proximity.emplace_back()};
}

// Squared distance of two world vertices, m^2.
inline double vertex_distance2(const Specimen& specimen, const Touch& touch, std::uint32_t a, std::uint32_t b) {
  const auto& vertices = specimen.header.scene.meshes[0]->vertices;
  double d2 = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = double(vertices[a][k]) + touch.frame->detected_position[touch.pair.i][k] -
                     (double(vertices[b][k]) + touch.frame->detected_position[touch.pair.j][k]);
    d2 += d * d;
  }
  return d2;
}

// Replaces the recorded witnesses by the first vertex pair whose true distance lies between the two bounds.
inline void retarget(Specimen& specimen, double above_m, double below_m) {
  const Touch touch = touch_of(specimen);
  const auto count = static_cast<std::uint32_t>(specimen.header.scene.meshes[0]->vertices.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = 0; b < count; ++b) {
      const double d2 = vertex_distance2(specimen, touch, a, b);
      if (d2 > above_m * above_m && d2 < below_m * below_m) {
        *touch.proximity = {static_cast<float>(d2), a, b};
        return;
      }
    }
  specimen.is_spoilable = false;
}

}  // namespace broadside::bench
