// Whether a mesh's surface crosses itself. Then its enclosed volume, and so its inertia, is undefined.
#pragma once

#include "core/scene/mesh.hpp"

namespace broadside::exact {

// True when two triangles that share no vertex have a point in common, decided by exact predicates. Triangles that
// share a vertex and cross beyond it are not searched for: except where a single edge is folded, other neighbors of
// theirs cross too.
bool crosses_itself(const core::Mesh& mesh);

}  // namespace broadside::exact
