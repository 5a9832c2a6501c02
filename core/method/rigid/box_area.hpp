// The area that faces of two boxes share, seen along the normal of their contact, and the four of its corners that are
// kept.
//
// The incident face is a parallelogram and the reference's a rectangle, so it is cut in the plane of the rectangle, by
// coordinates along its sides: what face_clipping.hpp does for any two faces.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core::box_detail {

// A parallelogram that is cut by a rectangle has at most eight corners. There is room for one more point, which the
// axis shows.
inline constexpr int kRoom = 9;

// A face of a box: half sides along its two axes, which make a right-handed frame with the axis that is normal to the
// face.
struct BoxFace {
  int face = 0;
  int u_axis = 0;
  int w_axis = 0;
  bool is_upper = false;
  Vec3 middle;
  Vec3 u;
  Vec3 w;
  float half_u = 0.0F;
  float half_w = 0.0F;
};

BROADSIDE_HD BoxFace face_of(const BoxPolytope& box, int face) {
  BoxFace f;
  f.face = face;
  const int axis = face / 2;
  f.u_axis = axis == 2 ? 0 : axis + 1;
  f.w_axis = axis == 0 ? 2 : axis - 1;
  f.is_upper = (face & 1) != 0;
  f.middle = box.center + (f.is_upper ? box.half[axis] : -box.half[axis]) * box.axes[axis];
  f.u = box.axes[f.u_axis];
  f.w = box.axes[f.w_axis];
  f.half_u = box.half[f.u_axis];
  f.half_w = box.half[f.w_axis];
  return f;
}

// In the plane of the reference's face, from its middle, seen along the normal.
struct FlatPoint {
  float u = 0.0F;
  float w = 0.0F;
  float gap_m = 0.0F;
  // Where it comes from: bits 0 to 7 are the point's number, as below; bits 8 to 15 are the line from here to the next
  // corner.
  std::uint32_t made_by = 0;
};

// Lines of the drawing: 0 to 3 are edges of the incident face, from its corner k on; 4 to 7 sides of the reference.
// Points: 0 to 3 are corners of the incident face; kCut + 4 line + side is where a side cuts a line; kShown marks the
// point that the axis shows.
inline constexpr std::uint32_t kSideLine = 4;
inline constexpr std::uint32_t kCut = 8;
inline constexpr std::uint32_t kShown = 0xFF;

// Marks names of the reference's corners, so that they differ from those of the incident face's corners.
inline constexpr std::uint32_t kReferenceCorner = 0x20000000U;

struct FlatArea {
  int count = 0;
  FlatPoint points[kRoom];
};

// Keeps the part that is at most slack_m beyond a side of the reference: line `side`, which is across u or w at the
// distance `half`, on the upper or the lower side. Works like clip() of face_clipping.hpp.
BROADSIDE_HD void cut_by_side(const FlatArea& area, FlatArea& kept, bool across_u, bool is_upper, float half,
                              std::uint32_t side, float slack_m) {
  const auto height = [&](const FlatPoint& p) {
    const float at = across_u ? p.u : p.w;
    return (is_upper ? at : -at) - half;
  };
  kept.count = 0;
  if (area.count == 0) return;
  FlatPoint here = area.points[0];
  float here_m = height(here);
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < area.count; ++k) {
    const FlatPoint next = area.points[k + 1 == area.count ? 0 : k + 1];
    const float next_m = height(next);
    const bool is_in = here_m <= slack_m;
    const bool is_cut = is_in != (next_m <= slack_m);
    const float inside = is_in ? here_m : next_m;
    const std::uint32_t leaving = here.made_by >> 8;
    const bool makes_corner = is_cut && inside < 0.0F;
    if (is_in && kept.count < kRoom) {
      kept.points[kept.count] = here;
      // A corner that lies on the side is no cut; the line that follows it is the side.
      if (is_cut && !makes_corner) kept.points[kept.count].made_by = (here.made_by & 0xFFU) | ((kSideLine + side) << 8);
      ++kept.count;
    }
    if (makes_corner && kept.count < kRoom) {
      // From the corner that is kept, so that equal edges are cut alike in both directions.
      const FlatPoint from = is_in ? here : next;
      const FlatPoint to = is_in ? next : here;
      const float share = inside / (inside - (is_in ? next_m : here_m));
      const std::uint32_t line = is_in ? kSideLine + side : leaving;
      kept.points[kept.count++] = {from.u + share * (to.u - from.u), from.w + share * (to.w - from.w),
                                   from.gap_m + share * (to.gap_m - from.gap_m),
                                   (kCut + 4 * leaving + side) | (line << 8)};
    }
    here = next;
    here_m = next_m;
  }
}

// Both faces, seen along `outward`: a unit direction out of the reference's body, toward which its face looks.
struct FlatView {
  BoxFace reference;
  BoxFace incident;
  Vec3 outward;
  // Components of outward along u and w: 0 to within rounding where outward is the face's own normal.
  float out_u = 0.0F;
  float out_w = 0.0F;
  float out_plane = 0.0F;
};

BROADSIDE_HD FlatPoint flat(const FlatView& v, Vec3 plane, Vec3 from_middle) {
  FlatPoint p;
  p.gap_m = dot(plane, from_middle) / v.out_plane;
  p.u = dot(v.reference.u, from_middle) - p.gap_m * v.out_u;
  p.w = dot(v.reference.w, from_middle) - p.gap_m * v.out_w;
  return p;
}

BROADSIDE_HD FlatView flat_view(const BoxPolytope& reference, int reference_face, const BoxPolytope& incident,
                                int incident_face, Vec3 outward) {
  FlatView v;
  v.reference = face_of(reference, reference_face);
  v.incident = face_of(incident, incident_face);
  v.outward = outward;
  v.out_u = dot(v.reference.u, outward);
  v.out_w = dot(v.reference.w, outward);
  v.out_plane = dot(reference.face_normal(reference_face), outward);
  return v;
}

// deepest: the incident face's lowest corner, before anything is cut.
BROADSIDE_HD void common_area_of(const FlatView& v, Vec3 plane, float rounding_m, FlatArea& area, FlatPoint& deepest) {
  const FlatPoint middle = flat(v, plane, v.incident.middle - v.reference.middle);
  const FlatPoint u = flat(v, plane, v.incident.half_u * v.incident.u);
  const FlatPoint w = flat(v, plane, v.incident.half_w * v.incident.w);
  area.count = 4;
  deepest.gap_m = 3.402823e38F;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < 4; ++k) {
    // As BoxPolytope::face_corner goes around: 00, 10, 11, 01; the lower face the other way.
    const int around = v.incident.is_upper ? k : 3 - k;
    const float at_u = around == 1 || around == 2 ? 1.0F : -1.0F;
    const float at_w = around >= 2 ? 1.0F : -1.0F;
    const auto number = static_cast<std::uint32_t>(k);
    const FlatPoint corner{middle.u + (at_u * u.u + at_w * w.u), middle.w + (at_u * u.w + at_w * w.w),
                           middle.gap_m + (at_u * u.gap_m + at_w * w.gap_m), number | (number << 8)};
    area.points[k] = corner;
    if (corner.gap_m < deepest.gap_m) deepest = corner;
  }
  FlatArea other;
  BROADSIDE_KEPT_LOOP
  for (int side = 0; side < 4; ++side) {
    const bool across_u = (side & 1) != 0;
    // Around the upper face: lower w, upper u, upper w, lower u; the lower face: upper w, upper u, lower w, lower u.
    const bool is_upper = across_u ? side == 1 : (side == 2) == v.reference.is_upper;
    // Two sides are cut from one area into the other one, two back.
    cut_by_side(across_u ? other : area, across_u ? area : other, across_u, is_upper,
                across_u ? v.reference.half_u : v.reference.half_w, static_cast<std::uint32_t>(side), rounding_m);
  }
}

// From corner k to the next one around a face.
BROADSIDE_HD std::uint32_t name_of_side(const BoxPolytope& box, int face, std::uint32_t k) {
  const int at = static_cast<int>(k);
  return edge_name(static_cast<std::uint32_t>(box.face_corner(face, at)),
                   static_cast<std::uint32_t>(box.face_corner(face, at == 3 ? 0 : at + 1)));
}

// Whether an edge of one box has the name of an edge of the other one's face: both count their corners alike.
BROADSIDE_HD bool has_side_named_as(int face, const BoxPolytope& other, int face_of_other, std::uint32_t k) {
  const int at = static_cast<int>(k);
  const int from = other.face_corner(face_of_other, at);
  const int to = other.face_corner(face_of_other, at == 3 ? 0 : at + 1);
  const int side = face & 1;
  return ((from >> (face / 2)) & 1) == side && ((to >> (face / 2)) & 1) == side;
}

// Names points like face_clipping.hpp, except corners of the reference whose name would be that of a cut: two points of
// one name count as one, and the patch would stand on three.
BROADSIDE_HD std::uint32_t key_of(const FlatView& v, const BoxPolytope& reference, const BoxPolytope& incident,
                                  std::uint32_t made_by, bool reference_is_a) {
  const std::uint32_t point = made_by & 0xFFU;
  std::uint32_t name = 0;
  if (point < kCut) {
    name = corner_name(static_cast<std::uint32_t>(incident.face_corner(v.incident.face, static_cast<int>(point))));
  } else {
    const std::uint32_t line = (point - kCut) / 4;
    const std::uint32_t side = (point - kCut) % 4;
    const bool is_corner = line >= kSideLine;
    const std::uint32_t earlier = line - kSideLine;
    if (is_corner && has_side_named_as(v.incident.face, reference, v.reference.face, earlier))
      name = kReferenceCorner | (4 * earlier + side);
    else
      name = feature_key(is_corner ? name_of_side(reference, v.reference.face, earlier)
                                   : name_of_side(incident, v.incident.face, line),
                         name_of_side(reference, v.reference.face, side));
  }
  const std::uint32_t plane = face_name(static_cast<std::uint32_t>(v.reference.face));
  return reference_is_a ? feature_key(plane, name) : feature_key(name, plane);
}

// The numbers of the four points that FourKept (contact_points.hpp) would keep: the deepest, the farthest from it
// across the normal, the one of the largest triangle with both, the one farthest outside that triangle. Among equal
// ones the first is taken, in the order of the area's corners. Areas are measured in the plane of the face; seen along
// the normal, all of them shrink by the same factor.
BROADSIDE_HD int pick_four(const FlatArea& area, float out_u, float out_w, float reach_m, int (&picked)[4]) {
  FlatPoint p[3];
  float turn = 1.0F;
  int count = 0;
  BROADSIDE_KEPT_LOOP
  for (int round = 0; round < 4; ++round) {
    int best = -1;
    float best_value = round == 0 ? -3.402823e38F : 0.0F;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < area.count; ++k) {
      const FlatPoint c = area.points[k];
      if (!(c.gap_m <= reach_m)) continue;
      const float u = c.u - p[0].u;
      const float w = c.w - p[0].w;
      float value = -c.gap_m;
      if (round == 1) {
        const float along = u * out_u + w * out_w;
        value = (u * u + w * w) - along * along;
      }
      if (round >= 2) {
        const float of_first = (p[1].u - p[0].u) * w - (p[1].w - p[0].w) * u;
        value = fabsf(of_first);
        if (round == 3) {
          const float of_second = (p[2].u - p[1].u) * (c.w - p[1].w) - (p[2].w - p[1].w) * (c.u - p[1].u);
          const float of_third = (p[0].u - p[2].u) * (c.w - p[2].w) - (p[0].w - p[2].w) * (c.u - p[2].u);
          value = fmaxf(-turn * of_first, fmaxf(-turn * of_second, -turn * of_third));
        }
      }
      if (!(value > best_value)) continue;
      best_value = value;
      best = k;
    }
    if (best < 0) break;
    picked[count++] = best;
    if (round < 3) {
      const FlatPoint chosen = area.points[best];
      if (round == 0) p[0] = chosen;
      if (round == 1) p[1] = chosen;
      if (round == 2) {
        p[2] = chosen;
        const float twice = (p[1].u - p[0].u) * (p[2].w - p[0].w) - (p[1].w - p[0].w) * (p[2].u - p[0].u);
        turn = twice < 0.0F ? -1.0F : 1.0F;
      }
    }
  }
  return count;
}

}  // namespace broadside::core::box_detail
