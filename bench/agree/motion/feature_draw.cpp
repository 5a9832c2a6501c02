#include "bench/agree/motion/feature_draw.hpp"

#include <cmath>
#include <string>

#include "core/pair.hpp"
#include "datasets/random.hpp"

namespace broadside::bench {
namespace {

using continuous::FeatureKind;
using continuous::MovingFeatures;
using core::Vec3d;
using datasets::RandomStream;

// On this grid sums, halves and products of a few coordinates are exact in double.
constexpr double kGrid = 1.0 / 256.0;

Vec3d somewhere(RandomStream& random) {
  return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
}

Vec3d on_grid(RandomStream& random) {
  const auto at = [&] { return kGrid * (static_cast<double>(random.below(512)) - 256.0); };
  return {at(), at(), at()};
}

Vec3d on_lattice(RandomStream& random) {
  const auto at = [&] { return static_cast<double>(random.below(4)); };
  return {at(), at(), at()};
}

void for_points(MovingFeatures& f, const auto& change) {
  for (int k = 0; k < 4; ++k) {
    change(f.start[k]);
    change(f.end[k]);
  }
}

void draw_all(MovingFeatures& f, RandomStream& random, Vec3d (*draw)(RandomStream&)) {
  for_points(f, [&](Vec3d& p) { p = draw(random); });
}

// Parallel motions: both edges keep one direction, or a vertex moves in parallel to the plane of a triangle that
// translates, in that plane or beside it.
void make_parallel(MovingFeatures& f, RandomStream& random) {
  draw_all(f, random, on_grid);
  const bool shares_plane = random.below(2) == 0;
  if (f.kind == FeatureKind::kEdgeEdge) {
    const Vec3d along = f.start[1] - f.start[0];
    const double length = 0.5 + 0.25 * random.below(5);
    f.end[1] = f.end[0] + along;
    f.start[3] = f.start[2] + length * along;
    f.end[3] = f.end[2] + length * along;
    // The vectors between the edges at the start and at the end lie in one plane with the edges.
    if (shares_plane) f.end[2] = f.end[0] + 0.5 * along - (0.25 * (1 + random.below(4))) * (f.start[2] - f.start[0]);
    if (shares_plane) f.end[3] = f.end[2] + length * along;
    return;
  }
  const Vec3d u = f.start[2] - f.start[1];
  const Vec3d v = f.start[3] - f.start[1];
  const auto weight = [&] { return 0.25 * (static_cast<double>(random.below(13)) - 4.0); };
  const Vec3d beside = shares_plane ? Vec3d{} : kGrid * on_lattice(random);
  f.end[2] = f.end[1] + u;
  f.end[3] = f.end[1] + v;
  f.start[0] = f.start[1] + weight() * u + weight() * v + beside;
  f.end[0] = f.end[1] + weight() * u + weight() * v + beside;
}

// At half the step the vertex lies on a triangle's edge, or the end of one edge on the other edge. Then one coordinate
// is moved by the smallest step of a double, up or down, or not at all.
void make_grazing(MovingFeatures& f, RandomStream& random) {
  draw_all(f, random, on_grid);
  const auto middle = [&](int k) { return 0.5 * (f.start[k] + f.end[k]); };
  const int first = f.kind == FeatureKind::kVertexFace ? 1 : 2;
  const Vec3d corner = 0.5 * (middle(first) + middle(first + 1));
  f.end[0] = 2.0 * corner - f.start[0];
  const auto axis = static_cast<int>(random.below(3));
  const std::uint32_t lot = random.below(3);
  if (lot > 0) f.end[0][axis] = std::nextafter(f.end[0][axis], lot == 1 ? 8.0 : -8.0);
}

void make_touching(MovingFeatures& f, RandomStream& random) {
  draw_all(f, random, on_grid);
  const double s = 0.25 * random.below(4);
  const double r = f.kind == FeatureKind::kVertexFace ? 0.25 * random.below(4) * (1.0 - s) : 0.25 * random.below(5);
  if (f.kind == FeatureKind::kVertexFace) {
    f.start[0] = f.start[1] + s * (f.start[2] - f.start[1]) + r * (f.start[3] - f.start[1]);
  } else {
    const Vec3d at = f.start[2] + r * (f.start[3] - f.start[2]);
    f.start[1] = at + (at - f.start[0]);
  }
}

// Coordinates are whole numbers over an odd denominator, so few of them are doubles. In half of the queries the
// features just touch where the motion ends: a vertex on the plane x + y + z = 1, or one edge's end on the line along
// (3, 5, 7).
exact::RationalFeatures fractions(FeatureKind kind, RandomStream& random) {
  exact::RationalFeatures out;
  out.kind = kind;
  const int denominators[] = {3, 5, 7, 9, 11};
  const int over = denominators[random.below(5)];
  const auto fraction = [&](int whole) { return exact::RationalText{std::to_string(whole), std::to_string(over)}; };
  for (auto& point : out.points)
    for (auto& coordinate : point) coordinate = fraction(static_cast<int>(random.below(5 * over)) - 2 * over);
  const bool is_face = kind == FeatureKind::kVertexFace;
  const int standing[] = {1, 2, 3};
  const int corners[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int ends[][3] = {{0, 0, 0}, {3, 5, 7}};
  for (int k = 0; k < (is_face ? 3 : 2); ++k)
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {0, 4})
        out.points[(is_face ? standing[k] : k) + step][axis] = {
            std::to_string(is_face ? corners[k][axis] : ends[k][axis])};
  if (random.below(2) == 0) return out;
  const int x = 1 + static_cast<int>(random.below(over - 2));
  const int y = static_cast<int>(random.below(over - x));
  if (is_face)
    out.points[4] = {fraction(x), fraction(y), fraction(over - x - y)};
  else
    out.points[6] = {fraction(3 * x), fraction(5 * x), fraction(7 * x)};
  return out;
}

}  // namespace

DrawnFeatures draw_features(MotionKind kind, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(core::splitmix64(seed ^ core::splitmix64(index + 1)));
  DrawnFeatures out;
  MovingFeatures f;
  f.kind = kind == MotionKind::kVertexFace ? FeatureKind::kVertexFace : FeatureKind::kEdgeEdge;
  // Every other query is drawn from the general family.
  out.family = static_cast<std::uint8_t>(index % 2 == 0 ? 0 : 1 + (index / 2) % (std::size(kFeatureFamilies) - 1));
  switch (out.family) {
    case 1:
      make_parallel(f, random);
      break;
    case 2: {
      draw_all(f, random, random.below(2) == 0 ? on_lattice : somewhere);
      for_points(f, [](Vec3d& p) { p.z = 0.5; });
      break;
    }
    case 3:
      make_grazing(f, random);
      break;
    case 4:
      make_touching(f, random);
      break;
    case 5:
      draw_all(f, random, random.below(2) == 0 ? on_lattice : somewhere);
      for (int k = 0; k < 4; ++k) f.end[k] = f.start[k];
      break;
    case 6:
    case 7: {
      draw_all(f, random, somewhere);
      const double scale = out.family == 6 ? 0x1p-100 : 0x1p100;
      for_points(f, [&](Vec3d& p) { p = scale * p; });
      break;
    }
    case 8: {
      draw_all(f, random, somewhere);
      const Vec3d offset = 0x1p20 * somewhere(random);
      for_points(f, [&](Vec3d& p) { p = p + offset; });
      break;
    }
    case 9:
      out.query = fractions(f.kind, random);
      return out;
    default:
      draw_all(f, random, somewhere);
  }
  out.query = exact::to_rational(f);
  return out;
}

core::Result<MotionTest> to_test(const exact::RationalFeatures& query, std::uint8_t family) {
  auto features = exact::rounded(query);
  if (!features) return features.error();
  const auto of_fractions = exact::first_touch(query);
  if (!of_fractions) return of_fractions.error();
  MotionTest test;
  test.family = family;
  test.features = features.value();
  test.truth = truth_of(test.features);
  test.truth.rounding_decides = of_fractions.value().touches != (test.truth.kind == MotionTruth::Kind::kTouch);
  return test;
}

}  // namespace broadside::bench
