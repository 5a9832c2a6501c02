// Checks that every narrow-phase adapter makes before it measures.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "core/engine/narrow_phase.hpp"

namespace broadside::reference {

// Errors: not as many poses as bodies that were loaded; a pair without i < j < bodies (named).
core::Status check_pairs(std::string_view engine, std::span<const core::Pair> pairs, std::span<const core::Pose> poses,
                         std::size_t body_count);

// The error of an engine of convex shapes when the scene has a mesh that is not convex.
core::Error no_shape(std::string_view engine, const core::Mesh& mesh);

// The error of an engine without cylinders when the mesh draws one: otherwise the engine would silently measure another
// shape.
core::Status refuse_cylinder(std::string_view engine, const core::Mesh& mesh);

}  // namespace broadside::reference
