#include "reference/rigid_world/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace broadside::reference {

PrincipalAxes principal_axes(const plain::Mat& inertia) {
  PrincipalAxes axes;
  axes.moments = {inertia.row[0].x, inertia.row[1].y, inertia.row[2].z};
  const double largest = std::max({axes.moments.x, axes.moments.y, axes.moments.z});
  const double off = std::max({std::abs(inertia.row[0].y), std::abs(inertia.row[0].z), std::abs(inertia.row[1].z)});
  if (off <= 0x1p-24 * largest) return axes;

  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = inertia.row[static_cast<std::size_t>(i)][j];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  Eigen::Matrix3d columns = solver.eigenvectors();
  if (columns.determinant() < 0.0) columns.col(2) = -columns.col(2);
  const Eigen::Quaterniond q(columns);
  axes.q = plain::normalized({q.w(), q.x(), q.y(), q.z()});
  axes.moments = {solver.eigenvalues()(0), solver.eigenvalues()(1), solver.eigenvalues()(2)};
  axes.is_turned = true;
  return axes;
}

}  // namespace broadside::reference
