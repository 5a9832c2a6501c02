// Decomposes a world transform into the position and rotation of a body and a rest that its mesh must take.
#pragma once

#include <array>
#include <optional>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// Three rows of four entries; points are column vectors on its right.
using Matrix = std::array<std::array<double, 4>, 3>;

inline constexpr Matrix kIdentity{{{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}};

struct Placement {
  Vec3 position;
  Quat orientation;
  // Scale, shear and mirroring, upper triangular, rounded to 20 bits of the largest entry. Products of float matrices
  // are no more exact, and instances that differ only in their placement keep equal rests. The fourth column is zero.
  Matrix rest = kIdentity;
};

// Nothing when the matrix is not finite or maps a direction to zero.
std::optional<Placement> taken_apart(const Matrix& matrix);

// Multiplies vertices by `rest`. Where it mirrors, triangles are reversed so that they keep facing outward.
void transform(Mesh& mesh, const Matrix& rest);

}  // namespace broadside::core
