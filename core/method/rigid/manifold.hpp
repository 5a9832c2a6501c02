// Where two bodies touch or nearly do: at most four points of one patch, with one normal. RIGID 8.4.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"

namespace broadside::core {

inline constexpr int kManifoldPoints = 4;

struct ManifoldPoint {
  // Halfway between the two surfaces, relative to A's center of mass, world axes, m: a difference of positions, so
  // that it is as exact a kilometer from the origin as at it. A's surface is at point + gap/2 normal, B's at point -
  // gap/2 normal.
  Vec3 point;
  float gap_m = 0.0F;  // along the normal; negative is penetration
  std::uint32_t feature =
      0;  // the same while the same corners, edges and faces meet, never 0: the key of warm starting
};

struct Manifold {
  Vec3 normal;  // unit, from B to A
  int count = 0;
  ManifoldPoint points[kManifoldPoints];
};

// The manifold of bodies a and b; b may be a face of the domain (kFirstFace + k). A pair of meshes may have more than
// one.
struct ContactPatch {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  Manifold manifold;
};

}  // namespace broadside::core
