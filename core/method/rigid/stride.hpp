// How far a body moves in a step, relative to its thickness: RIGID 8.7.
#pragma once

#include "core/attributes.hpp"

namespace broadside::core {

// How far the fastest point of a body goes, over half the body's thickness.
BROADSIDE_HD float stride_of(float fastest_of_body_m_s, float half_thickness_m, float dt_s) {
  return half_thickness_m > 0.0F ? fastest_of_body_m_s * dt_s / half_thickness_m : 0.0F;
}

}  // namespace broadside::core
