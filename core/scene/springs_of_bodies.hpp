// Springs by body, and whether a scene's step is short enough for them. METHOD section 1.
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/variant.hpp"

namespace broadside::core {

// Springs grouped by body, in the scene's order: those of body i are springs[begin[i] .. begin[i + 1]). Both are empty
// when the scene has none.
struct SpringsOfBodies {
  std::vector<Spring> springs;
  std::vector<std::uint32_t> begin;
};

SpringsOfBodies springs_of_bodies(const Scene& scene);

// A step at or above the limit of P(4) would diverge: the error names the body and its limit. printed-E1 uses P(4) as
// printed and so accepts longer steps.
Status check_spring_step(const Scene& scene, Variant variant);

}  // namespace broadside::core
