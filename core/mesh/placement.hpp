// A transform of the world taken apart into what a body has, place and rotation, and what its mesh must take.
#pragma once

#include <array>
#include <optional>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// Three rows of four; a point is transformed from the right.
using Matrix = std::array<std::array<double, 4>, 3>;

inline constexpr Matrix kIdentity{{{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}};

struct Placement {
  Vec3 position;
  Quat orientation;
  // Scale, shear and mirroring, upper triangular, rounded to 20 bits of the largest entry: products of float matrices
  // are no more exact, and instances that differ only in place keep equal rests. The fourth column is zero.
  Matrix rest = kIdentity;
};

// Nothing when the matrix is not finite or flattens a direction.
std::optional<Placement> taken_apart(const Matrix& matrix);

// Vertices times `rest`; where it mirrors, triangles are turned round so that they keep facing outward.
void transform(Mesh& mesh, const Matrix& rest);

}  // namespace broadside::core
