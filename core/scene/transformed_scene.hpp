// Scenes derived from another scene, such that their outcomes follow from its outcomes.
#pragma once

#include <cstdint>
#include <span>

#include "core/scene/scene.hpp"

namespace broadside::core {

// Multiplies every length by `factor`, and with it velocities, gravity, and the parameters that are lengths, speeds or
// impulses; masses, times and materials stay. With a power of two, every float32 result is the original's times that
// factor, bit for bit, as long as nothing overflows or becomes subnormal.
Scene scaled_scene(const Scene& scene, float factor);

// x -> -x for axis 0, and so on: positions, velocities, meshes (with triangles reversed, so that they still face
// outward), orientations, domain, gravity. Rounding is symmetric, so the outcome is the original's mirrored, bit for
// bit.
Scene mirrored_scene(const Scene& scene, int axis);

// Rotated by 90 degrees about an axis, counterclockwise seen from its tip: y becomes z for axis 0, and so on. Bodies
// and meshes rotate, so that orientations keep their components; coordinates change places and signs, and nothing is
// rounded.
Scene turned_scene(const Scene& scene, int axis);

// Body k of the result is body order[k] of the scene. order: a permutation.
Scene renumbered_scene(const Scene& scene, std::span<const std::uint32_t> order);

// Scales every mesh about its body's origin, and changes nothing else. With factor >= 1, boxes around that origin
// contain the original's, and so the pairs include the original's pairs.
Scene grown_scene(const Scene& scene, float factor);

}  // namespace broadside::core
