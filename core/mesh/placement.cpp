#include "core/mesh/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace broadside::core {
namespace {

Quat quaternion(const Matrix& r) {
  // Starts with the largest of the four components, so that no division is by almost zero (Shepperd).
  const double trace = r[0][0] + r[1][1] + r[2][2];
  std::array<double, 4> q{trace, r[0][0], r[1][1], r[2][2]};
  const auto top = static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin());
  if (top == 0) {
    q = {1.0 + trace, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  } else {
    const std::size_t i = top - 1, j = top % 3, k = (top + 1) % 3;
    q[0] = r[k][j] - r[j][k];
    q[1 + i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
    q[1 + j] = r[j][i] + r[i][j];
    q[1 + k] = r[k][i] + r[i][k];
  }
  const double norm = std::sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
  const double sign = q[0] < 0.0 ? -1.0 : 1.0;
  const auto component = [&](std::size_t n) { return static_cast<float>(sign * q[n] / norm); };
  return {component(0), component(1), component(2), component(3)};
}

double rounded_to_20_bits(double v, double largest) {
  const double unit = std::exp2(std::floor(std::log2(largest)) - 20.0);
  return std::round(v / unit) * unit;
}

}  // namespace

std::optional<Placement> taken_apart(const Matrix& m) {
  // Gram-Schmidt on the columns. For a mirrored frame the third axis is reversed, and the mirroring stays in the rest.
  Matrix rotation{};
  for (unsigned c = 0; c < 3; ++c) {
    std::array<double, 3> axis{m[0][c], m[1][c], m[2][c]};
    for (unsigned before = 0; before < c; ++before) {
      double along = 0.0;
      for (unsigned r = 0; r < 3; ++r) along += axis[r] * rotation[r][before];
      for (unsigned r = 0; r < 3; ++r) axis[r] -= along * rotation[r][before];
    }
    const double norm = std::sqrt((axis[0] * axis[0] + axis[1] * axis[1]) + axis[2] * axis[2]);
    if (!(norm > 0.0) || !std::isfinite(norm)) return std::nullopt;
    for (unsigned r = 0; r < 3; ++r) rotation[r][c] = axis[r] / norm;
  }
  const auto& [x, y, z] = rotation;
  const double determinant =
      x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
  if (determinant < 0.0)
    for (auto& row : rotation) row[2] = -row[2];
  Placement p;
  double largest = 0.0;
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 3; ++c) {
      p.rest[r][c] = rotation[0][r] * m[0][c] + rotation[1][r] * m[1][c] + rotation[2][r] * m[2][c];
      largest = std::max(largest, std::abs(p.rest[r][c]));
    }
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 3; ++c) p.rest[r][c] = rounded_to_20_bits(p.rest[r][c], largest);
  p.position = {static_cast<float>(m[0][3]), static_cast<float>(m[1][3]), static_cast<float>(m[2][3])};
  p.orientation = quaternion(rotation);
  return p;
}

void transform(Mesh& mesh, const Matrix& m) {
  for (Vec3& v : mesh.vertices) {
    const Vec3 p = v;
    for (unsigned r = 0; r < 3; ++r)
      v[static_cast<int>(r)] = static_cast<float>((m[r][0] * p.x + m[r][1] * p.y) + m[r][2] * p.z);
  }
  // The rest is triangular, so its diagonal shows whether it mirrors.
  if (m[0][0] * m[1][1] * m[2][2] < 0.0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace broadside::core
