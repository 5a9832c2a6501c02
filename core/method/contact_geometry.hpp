// The contact of two overlapping boxes, or of a box and a face of the domain: METHOD section 4.
#pragma once

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

struct ContactGeometry {
  bool exists = false;
  int axis = 0;
  float depth_m = 0.0F;  // > 0
  Vec3 normal;           // unit, from B to A
};

// P(9), P(10). No contact unless the overlap is positive on every axis. Ties go to the lowest axis index. The sign is
// that of the centers' difference on the chosen axis. Where the centers coincide on that axis it is +, and bodies whose
// centers are nearer than epsilon in every axis take the fixed axis +x.
BROADSIDE_HD ContactGeometry box_contact(const Box& a, const Box& b, float epsilon_m) {
  ContactGeometry contact;
  const Vec3 ca = center(a);
  const Vec3 cb = center(b);
  float depth[3];
  for (int k = 0; k < 3; ++k) {
    const float top = a.max[k] < b.max[k] ? a.max[k] : b.max[k];
    const float bottom = a.min[k] > b.min[k] ? a.min[k] : b.min[k];
    depth[k] = top - bottom;
    if (!(depth[k] > 0.0F)) return contact;
  }
  contact.exists = true;
  const Vec3 between = ca - cb;
  const bool coincide = dot(between, between) < epsilon_m * epsilon_m;
  if (!coincide) {
    if (depth[1] < depth[contact.axis]) contact.axis = 1;
    if (depth[2] < depth[contact.axis]) contact.axis = 2;
  }
  contact.depth_m = depth[contact.axis];
  const bool negative = !coincide && between[contact.axis] < 0.0F;
  contact.normal = axis_vector(contact.axis, negative ? -1.0F : 1.0F);
  return contact;
}

// Faces of the domain, 0..5 = -x +x -y +y -z +z, are static half-spaces: the depth is how far the body's box passes the
// face, and the normal points inward. These faces are ours: the paper keeps its bodies in a box and does not say how.
BROADSIDE_HD ContactGeometry face_contact(const Box& body, const Box& domain, int face) {
  ContactGeometry contact;
  contact.axis = face >> 1;
  const bool upper = (face & 1) != 0;
  contact.depth_m =
      upper ? body.max[contact.axis] - domain.max[contact.axis] : domain.min[contact.axis] - body.min[contact.axis];
  contact.exists = contact.depth_m > 0.0F;
  contact.normal = axis_vector(contact.axis, upper ? -1.0F : 1.0F);
  return contact;
}

}  // namespace broadside::core
