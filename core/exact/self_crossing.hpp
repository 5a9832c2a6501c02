// Whether a mesh's surface crosses itself: then what it encloses, and so its inertia, is not defined.
#pragma once

#include "core/scene/mesh.hpp"

namespace broadside::exact {

// Two triangles that share no vertex have a point in common, decided by exact predicates. Triangles that share a vertex
// and cross beyond it are not looked for: their other neighbors cross too, but for folds of a single edge.
bool crosses_itself(const core::Mesh& mesh);

}  // namespace broadside::exact
