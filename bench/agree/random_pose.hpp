// Places and orientations of bodies that are drawn for a comparison.
#pragma once

#include "core/exact/triangle_distance.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "datasets/random.hpp"

namespace broadside::bench {

// The nearest place of a scene's precision, m.
core::Vec3 to_core(exact::Point p);

// Uniform over orientations, as four numbers in a ball.
core::Quat random_orientation(datasets::RandomStream& random);

}  // namespace broadside::bench
