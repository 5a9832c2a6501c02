// The catalogue of wrong traces: each takes one sound recording and breaks one law, and names the validator that must
// reject it. Others may reject it too: a broken state is broken in many ways.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "tests/validation/sound_world.hpp"

namespace broadside::tests {

struct Mutation {
  std::string_view validator;
  std::string_view what;
  void (*apply)(Recording&);
  bool against_the_sound_one = false;  // judged with the sound recording as its baseline
};

// The first contact that fits; the recording has one of each kind that the catalogue asks for (see
// SoundTrace.HasEveryKindOfContact).
template <typename Fits>
Contact& contact_that(Recording& recording, Fits fits) {
  for (FrameRecord& frame : recording.frames)
    for (Contact& c : frame.contacts)
      if (fits(c)) return c;
  ADD_FAILURE() << "the recording has no such contact";
  return recording.frames.front().contacts.front();
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

inline FrameRecord& frame_with_pairs(Recording& recording) {
  for (FrameRecord& frame : recording.frames)
    if (!frame.pairs.empty()) return frame;
  ADD_FAILURE() << "the recording has no pairs";
  return recording.frames.front();
}

// A touching pair and its proximity.
struct Touch {
  FrameRecord* frame;
  Pair pair;
  core::Proximity* proximity;
};

inline Touch touch_of(Recording& recording) {
  for (FrameRecord& frame : recording.frames)
    for (std::size_t k = 0; k < frame.confirmed.size(); ++k)
      if (frame.proximity[k].is_touching()) return {&frame, frame.confirmed[k], &frame.proximity[k]};
  ADD_FAILURE() << "the recording has no touching pair";
  return {&recording.frames.front(), {}, nullptr};
}

// Squared distance of two world vertices, m^2.
inline double vertex_distance2(const Recording& recording, const Touch& touch, std::uint32_t a, std::uint32_t b) {
  const auto& vertices = recording.header.scene.meshes[0]->vertices;
  double d2 = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = double(vertices[a][k]) + touch.frame->detected_position[touch.pair.i][k] -
                     (double(vertices[b][k]) + touch.frame->detected_position[touch.pair.j][k]);
    d2 += d * d;
  }
  return d2;
}

// Replaces the recorded witnesses by the first vertex pair whose true distance lies between the two bounds.
inline void retarget(Recording& recording, double above_m, double below_m) {
  const Touch touch = touch_of(recording);
  const auto count = static_cast<std::uint32_t>(recording.header.scene.meshes[0]->vertices.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = 0; b < count; ++b) {
      const double d2 = vertex_distance2(recording, touch, a, b);
      if (d2 > above_m * above_m && d2 < below_m * below_m) {
        *touch.proximity = {static_cast<float>(d2), a, b};
        return;
      }
    }
  ADD_FAILURE() << "no vertex pair between " << above_m << " and " << below_m;
}

}  // namespace broadside::tests
