// Axes in which an inertia is diagonal, for engines that store three moments for each body.
#pragma once

#include "reference/plain_rigid/linear.hpp"

namespace broadside::reference {

struct PrincipalAxes {
  plain::Quaternion q;     // unit; mesh axes from principal axes
  plain::Vec moments;      // kg m^2
  bool is_turned = false;  // false: the mesh's axes are principal themselves, and q is 1 exactly
};

// Mesh axes count as principal where float32, which rounds to 2^-24 of the largest moment, cannot tell the difference.
PrincipalAxes principal_axes(const plain::Mat& inertia);

}  // namespace broadside::reference
