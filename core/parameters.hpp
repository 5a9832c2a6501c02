// The method's parameters (P-Table 1), one value per scene. Trivially copyable: kernels take it by value.
#pragma once

namespace broadside::core {

struct Parameters {
  // Slop: penetration that position correction leaves alone. In meters. A larger slop is calmer at rest, and bodies
  // visibly sink deeper.
  float delta_m = 0.001F;
  // Share of the penetration above the slop that one application corrects, 0 < beta <= 1.
  float beta = 1.0F;
  // Smoothing of the corrected position, 0 < alpha <= 1; 1 = none, P(13).
  float alpha = 1.0F;
  // Approach speeds below this do not bounce, P(17). In m/s.
  float v_threshold_m_s = 0.3F;
  // Floor of the normal impulse, P(18), applied only up to the energy-neutral impulse (E5). In N s, >= 0.
  float impulse_min_n_s = 0.01F;
  // Each velocity component is clipped to +- this, P(23). In m/s.
  float v_max_m_s = 50.0F;
  // Box centers nearer than this have no usable direction: the contact takes the fixed axis +x. In meters.
  float epsilon_m = 1e-6F;
  // Vertices nearer than this touch, P(8). In meters. 0 = the mean edge length of the pair's two meshes.
  float theta_m = 0.0F;
  // Cell of the spatial hash. In meters.
  float hash_cell_m = 0.25F;
};

static_assert(sizeof(Parameters) == 36, "kernel parameter: host and device must agree on its layout");

}  // namespace broadside::core
