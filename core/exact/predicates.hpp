// Signs that are right in spite of rounding: orientation of points, and whether two triangles meet.
#pragma once

#include "core/exact/triangle_distance.hpp"

namespace broadside::exact {

// +1 when d lies on the side of the plane a b c from which a, b, c are seen clockwise (the determinant of a-d, b-d, c-d
// is positive), -1 on the other side, 0 exactly on it. Decided by expansions of doubles after Shewchuk (Adaptive
// Precision Floating-Point Arithmetic, 1997), behind a filter on the plain determinant. Exact as long as no product of
// three coordinates overflows or falls below 1e-290.
int orientation(Point a, Point b, Point c, Point d);

// Closed triangles have a point in common: also when they only touch, lie in one plane, or are segments or points.
bool triangles_meet(const Corners& a, const Corners& b);

}  // namespace broadside::exact
