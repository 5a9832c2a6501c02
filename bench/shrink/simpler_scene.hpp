// The edits that the shrinker tries: scenes with fewer or simpler parts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace broadside::bench {

// Nine digits are enough to name every float, so fewer digits may change it.
inline constexpr int kAllDigits = 9;

// The scene with only these bodies, in the scene's order, and the meshes and springs that they use.
core::Scene with_bodies(const core::Scene& scene, std::span<const std::uint32_t> bodies);

// The scene with only these springs.
core::Scene with_springs(const core::Scene& scene, std::span<const std::uint32_t> springs);

// All bodies, sorted by the distance from the nearest body of `from`; those of `from` come first.
std::vector<std::uint32_t> by_distance(const core::Scene& scene, std::span<const std::uint32_t> from);

// Mesh m replaced by a box of the same extent with one square a side: 12 triangles. None when its box is flat or it has
// no more than 12.
std::optional<core::Scene> with_box_mesh(const core::Scene& scene, std::size_t m);
// Mesh m with only these triangles, cleaned. None when no triangle with area is left.
std::optional<core::Scene> with_triangles(const core::Scene& scene, std::size_t m,
                                          std::span<const std::uint32_t> triangles);

// Edits of one kind each; an edit that changes nothing gives the same scene.
enum class Plainer : std::uint8_t {
  kNoGravity,
  kWideDomain,         // so far away that no body meets a face
  kOneMaterial,        // of all bodies and faces: that of the defaults
  kDefaultParameters,  // P-Table 1
  kUnitMass,           // of every body that is not static
  kNoTurn,             // orientation and angular velocity
  kAtOrigin,           // the first body at the origin; the others, the domain and anchors moved with it
  kNoDescription,      // name and seed of the scene this came from
};
inline constexpr int kPlainerCount = 8;
core::Scene made_plainer(const core::Scene& scene, Plainer how);

// Number k of the numbers whose digits can go: positions and velocities of all bodies, then mesh vertices, then domain,
// then springs.
std::uint64_t digit_count(const core::Scene& scene);
// Number k rounded to this many significant digits; 0 digits = zero.
core::Scene with_digits(const core::Scene& scene, std::uint64_t k, int digits);
core::Scene with_digits_everywhere(const core::Scene& scene, int digits);

// The float nearest to the number written with this many significant decimal digits; 0 digits = zero.
float rounded_to(float value, int digits);

}  // namespace broadside::bench
