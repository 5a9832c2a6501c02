// Removes from a mesh what no engine can use, and counts it: repeated points, triangles without area, stray vertices.
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// What cleaning removed. Vertices and triangles that remain keep their order.
struct Dropped {
  std::uint64_t repeated_vertices = 0;      // equal to an earlier vertex, bit for bit: merged into it
  std::uint64_t collapsed_triangles = 0;    // two corners are one vertex
  std::uint64_t zero_area_triangles = 0;    // three corners on one line
  std::uint64_t unreferenced_vertices = 0;  // in no triangle that remains

  [[nodiscard]] bool is_nothing() const {
    return repeated_vertices + collapsed_triangles + zero_area_triangles + unreferenced_vertices == 0;
  }
  // "2 repeated vertices, 1 triangle without area"; "nothing".
  [[nodiscard]] std::string text() const;
};

// Cleans in place. Triangle indices must exist and vertices be finite. A triangle has no area when its exact cross
// product is zero. Differences of floats are exact in double unless their exponents lie more than 29 apart, and so are
// products of two 24-bit differences: the test is a fact about the file, not a tolerance.
Dropped clean_mesh(Mesh& mesh);

// Scales the mesh uniformly and moves it so that the longest side of its box is `longest_side_m` and the box's center
// is the origin. Computed in double and rounded to float once per coordinate, so every machine gets the same bits. The
// box must not be a point (any mesh that load_mesh returned is fine).
Mesh normalized(Mesh mesh, double longest_side_m);

}  // namespace broadside::core
