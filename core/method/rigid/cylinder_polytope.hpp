// A cylinder as a polytope for the search of axes and features: a prism with sixteen corners at each end. The corners
// lie on the true rims, and can be gathered where the cylinder touches. Its extent along a direction is that of the
// round body.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/lanes.hpp"

namespace broadside::core {

inline constexpr int kRimCorners = 16;

// Passes of gathering corners. Pass 0 is the even prism. In each later pass, the corners that lie close together around
// the given direction span the arc between two corners of the pass before. After the last pass a chord is off the rim
// by the radius times (0.001 rad)^2 / 8, which is two roundings.
inline constexpr int kRimPasses = 4;

namespace rim_detail {

// Cosine and sine of the angles from the middle corner, one side: 0.06, 0.13, 0.2, 0.28, 0.38, 0.8, 1.8 rad; then
// 0.008, 0.016, 0.026, 0.04, 0.07, 0.6, 1.7; then 0.001, 0.002, 0.0035, 0.006, 0.012, 0.5, 1.7. The sixteenth is
// opposite.
BROADSIDE_HD Vec3 rim_angle(int pass, int k) {
  constexpr float kCosine[3][7] = {
      {0.99820054F, 0.991561894F, 0.980066578F, 0.961055438F, 0.928664636F, 0.696706709F, -0.227202095F},
      {0.999968F, 0.999872003F, 0.999662019F, 0.999200107F, 0.997551F, 0.825335615F, -0.128844494F},
      {0.9999995F, 0.999998F, 0.999993875F, 0.999982F, 0.999928001F, 0.877582562F, -0.128844494F}};
  constexpr float kSine[3][7] = {
      {0.0599640065F, 0.129634143F, 0.198669331F, 0.276355649F, 0.370920469F, 0.717356091F, 0.973847631F},
      {0.00799991467F, 0.0159993173F, 0.0259970708F, 0.0399893342F, 0.0699428473F, 0.564642473F, 0.99166481F},
      {0.000999999833F, 0.00199999867F, 0.00349999285F, 0.005999964F, 0.011999712F, 0.479425539F, 0.99166481F}};
  // Evenly: the first quarter of sixteen.
  constexpr float kEven[4] = {1.0F, 0.923879533F, 0.707106781F, 0.382683432F};
  if (pass == 0) {
    const int quarter = k / 4;
    const float c = kEven[k % 4];
    const float s = k % 4 == 0 ? 0.0F : kEven[4 - k % 4];
    return quarter == 0   ? Vec3{c, s, 0.0F}
           : quarter == 1 ? Vec3{-s, c, 0.0F}
           : quarter == 2 ? Vec3{-c, -s, 0.0F}
                          : Vec3{s, -c, 0.0F};
  }
  if (k == 0) return {1.0F, 0.0F, 0.0F};
  if (k == 8) return {-1.0F, 0.0F, 0.0F};
  return k < 8 ? Vec3{kCosine[pass - 1][k - 1], kSine[pass - 1][k - 1], 0.0F}
               : Vec3{kCosine[pass - 1][15 - k], -kSine[pass - 1][15 - k], 0.0F};
}

}  // namespace rim_detail

// Corners 0 to 15 are those of the lower end, 16 to 31 of the upper one. Faces 0 and 1 are the ends, 2 + k the side
// from corner k to the next. Edges: 16 around the lower end, 16 around the upper one, 16 along.
struct CylinderPolytope {
  using Lanes = OneLane;
  static constexpr int kMostFaceCorners = kRimCorners;
  static constexpr bool kIsSheet = false;
  Vec3 center;
  Vec3 along;  // unit
  float half_length = 0.0F;
  float radius = 0.0F;
  Vec3 rim[kRimCorners];  // unit, across

  BROADSIDE_HD int corner_count() const { return 2 * kRimCorners; }
  BROADSIDE_HD int edge_count() const { return 3 * kRimCorners; }
  BROADSIDE_HD int face_count() const { return 2 + kRimCorners; }
  BROADSIDE_HD Vec3 corner(int k) const {
    const float side = k < kRimCorners ? -half_length : half_length;
    return center + side * along + radius * rim[k % kRimCorners];
  }
  BROADSIDE_HD void edge(int k, int& from, int& to) const {
    const int at = k % kRimCorners;
    const int next = at + 1 == kRimCorners ? 0 : at + 1;
    const int end = k / kRimCorners;
    from = end == 1 ? kRimCorners + at : at;
    to = end == 0 ? next : kRimCorners + (end == 1 ? next : at);
  }
  BROADSIDE_HD void edge_faces(int k, int& left, int& right) const {
    const int at = k % kRimCorners;
    const int end = k / kRimCorners;
    left = 2 + at;
    right = end < 2 ? end : 2 + (at == 0 ? kRimCorners - 1 : at - 1);
  }
  BROADSIDE_HD Vec3 face_normal(int k) const {
    if (k < 2) return k == 0 ? -along : along;
    return normalized(rim[k - 2] + rim[k - 1 == kRimCorners ? 0 : k - 1]);
  }
  BROADSIDE_HD float face_height(int k) const { return -least(-face_normal(k)); }
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return x; }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(face_normal(k), x) - face_height(k); }
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return direction; }
  BROADSIDE_HD float height(int k, Vec3 direction) const { return dot(direction, corner(k)); }
  BROADSIDE_HD int face_corner_count(int k) const { return k < 2 ? kRimCorners : 4; }
  // Anticlockwise seen from outside.
  BROADSIDE_HD int face_corner(int face, int k) const {
    if (face == 0) return kRimCorners - 1 - k;
    if (face == 1) return kRimCorners + k;
    const int at = face - 2;
    const int next = at + 1 == kRimCorners ? 0 : at + 1;
    return k == 0 ? at : (k == 1 ? next : (k == 2 ? kRimCorners + next : kRimCorners + at));
  }
  // Of the round body.
  BROADSIDE_HD float least(Vec3 direction) const {
    const float on_axis = dot(direction, along);
    return dot(direction, center) - (fabsf(on_axis) * half_length + radius * length(direction - on_axis * along));
  }
  BROADSIDE_HD float least_at(int, Vec3 direction) const { return least(direction); }
  // An end face if its normal is less than 45 degrees from the direction, else the side that looks along the direction
  // most.
  BROADSIDE_HD int support_face(Vec3 direction) const {
    const float on_axis = dot(direction, along);
    if (fabsf(on_axis) >= 0.70710678F) return on_axis > 0.0F ? 1 : 0;
    int best = 2;
    float most = -2.0F;
    BROADSIDE_KEPT_LOOP
    for (int k = 2; k < face_count(); ++k) {
      const float facing = dot(face_normal(k), direction);
      if (!(facing > most)) continue;
      most = facing;
      best = k;
    }
    return best;
  }
};

// pass 0: even, in the directions of the body's axes. Later passes: gathered around `towards`, the direction from the
// axis to where the cylinder touches; even again if that direction has no part across the axis.
BROADSIDE_HD_CALLED CylinderPolytope cylinder_polytope(const PlacedShape& p, int pass, Vec3 towards) {
  const int axis = p.shape->axis;
  CylinderPolytope out;
  out.center = p.center;
  out.along = p.axes[axis];
  out.half_length = p.shape->half_length_m;
  out.radius = p.shape->radius_m;
  Vec3 u = p.axes[axis == 2 ? 0 : axis + 1];
  if (pass > 0) {
    const Vec3 across = direction_across(out.along, towards);
    if (dot(across, across) > 0.0F)
      u = across;
    else
      pass = 0;
  }
  const Vec3 w = cross(out.along, u);
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < kRimCorners; ++k) {
    const Vec3 angle = rim_detail::rim_angle(pass, k);
    out.rim[k] = angle.x * u + angle.y * w;
  }
  return out;
}

}  // namespace broadside::core
