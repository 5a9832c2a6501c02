// Position correction and velocity update of one contact: METHOD sections 5 and 6, with the printed forms E3 to E6.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/material.hpp"
#include "core/math/vec3.hpp"
#include "core/method/contact_geometry.hpp"
#include "core/parameters.hpp"
#include "core/variant.hpp"

namespace broadside::core {

// The paper has no faces, so its swapped masses (E3) apply to pairs alone. At a face, a body would never leave the
// floor, and that would hide the swap behind another fault.
BROADSIDE_HD constexpr Variant face_variant(Variant variant) {
  return variant == Variant::kE3 ? Variant::kSound : variant;
}

// P(11), P(12) in P-Alg 3's form, P(13). wA + wB > 0.
BROADSIDE_HD void correct_positions(Contact& c, float w_a, float w_b, const Parameters& p, Variant variant) {
  const float above_slop = c.depth_m - p.delta_m;
  // E4, P(14): without the clamp, a contact inside the slop is pushed deeper.
  const float corrected = (above_slop > 0.0F || variant == Variant::kE4) ? above_slop : 0.0F;
  const float magnitude = p.alpha * (p.beta * corrected);
  // E3, P(12): each body is given the other body's share.
  const float share_a = (variant == Variant::kE3 ? w_b : w_a) / (w_a + w_b);
  const float share_b = (variant == Variant::kE3 ? w_a : w_b) / (w_a + w_b);
  c.post_a.x = c.pre_a.x + (share_a * magnitude) * c.normal;
  c.post_b.x = c.pre_b.x - (share_b * magnitude) * c.normal;
}

// P(17), P(18). v_n < 0 (approaching). The floor J_min is applied only up to the energy-neutral impulse, which is the
// one that restitution 1 would give; as printed it adds energy to light or slow bodies (E5).
BROADSIDE_HD float normal_impulse(float v_n, float w_sum, float restitution, const Parameters& p, Variant variant) {
  const float e = -v_n < p.v_threshold_m_s ? 0.0F : restitution;
  const float impulse = -(1.0F + e) * v_n / w_sum;
  if (!(impulse < p.impulse_min_n_s)) return impulse;
  if (variant == Variant::kE5) return p.impulse_min_n_s;
  const float neutral = -2.0F * v_n / w_sum;
  const float floor = p.impulse_min_n_s < neutral ? p.impulse_min_n_s : neutral;
  return impulse > floor ? impulse : floor;
}

// P(20), P(21): signed along the direction of sliding, so a correct one is <= 0.
BROADSIDE_HD float tangent_impulse(float slide_speed, float w_sum, float j_n, const Material& m, Variant variant) {
  const float stop = -slide_speed / w_sum;
  if (-stop <= m.mu_static * j_n) return stop;
  // E6: the printed -mu_k J_n sign(J*) comes out positive and accelerates the sliding.
  return variant == Variant::kE6 ? m.mu_kinetic * j_n : -m.mu_kinetic * j_n;
}

// P(16) to P(22). Friction uses the velocities before the normal impulse, because P(16) defines v_t only once.
BROADSIDE_HD void update_velocities(Contact& c, float w_a, float w_b, const Material& m, const Parameters& p,
                                    Variant variant) {
  const Vec3 relative = c.pre_a.v - c.pre_b.v;
  const float v_n = dot(relative, c.normal);
  if (!(v_n < 0.0F)) return;
  const float w_sum = w_a + w_b;
  c.normal_impulse_n_s = normal_impulse(v_n, w_sum, m.restitution, p, variant);
  c.post_a.v = c.post_a.v + (c.normal_impulse_n_s * w_a) * c.normal;
  c.post_b.v = c.post_b.v - (c.normal_impulse_n_s * w_b) * c.normal;

  const Vec3 sliding = relative - v_n * c.normal;
  const float slide_speed = length(sliding);
  if (!(slide_speed > 0.0F)) return;
  c.tangent = {sliding.x / slide_speed, sliding.y / slide_speed, sliding.z / slide_speed};
  c.tangent_impulse_n_s = tangent_impulse(slide_speed, w_sum, c.normal_impulse_n_s, m, variant);
  c.post_a.v = c.post_a.v + (w_a * c.tangent_impulse_n_s) * c.tangent;
  c.post_b.v = c.post_b.v - (w_b * c.tangent_impulse_n_s) * c.tangent;
}

// One whole application: computes normal, depth, impulses and post states from the pre states in c.
BROADSIDE_HD void respond(Contact& c, const ContactGeometry& geometry, float w_a, float w_b, const Material& m,
                          const Parameters& p, Variant variant) {
  c.depth_m = geometry.depth_m;
  c.normal = geometry.normal;
  c.tangent = {};
  c.normal_impulse_n_s = 0.0F;
  c.tangent_impulse_n_s = 0.0F;
  c.post_a = c.pre_a;
  c.post_b = c.pre_b;
  correct_positions(c, w_a, w_b, p, variant);
  update_velocities(c, w_a, w_b, m, p, variant);
}

// P(23): limits each component, not the speed.
BROADSIDE_HD Vec3 clipped(Vec3 v, float v_max) {
  for (int k = 0; k < 3; ++k) {
    if (v[k] > v_max) v[k] = v_max;
    if (v[k] < -v_max) v[k] = -v_max;
  }
  return v;
}

}  // namespace broadside::core
