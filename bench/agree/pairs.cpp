#include "bench/agree/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/agree/random_pose.hpp"
#include "core/mesh/load_mesh.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/random.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/convex_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::bench {
namespace {

using core::Quat;
using core::Vec3;
using datasets::RandomStream;
using exact::Point;

constexpr int kShapes = 24;       // of each kind; there are a third as many plates and needles
constexpr int kOrientations = 8;  // that are drawn for meshes
// Ratio of the short sides of plates and needles to their long sides. Below this ratio the answer depends on the
// resolution of floats, and no longer on the shape.
constexpr double kThin = 0.02;

std::array<double, 3> sides(RandomStream& random, Degeneracy form) {
  std::array<double, 3> s{random.between(0.3, 1.0), random.between(0.3, 1.0), random.between(0.3, 1.0)};
  if (form == Degeneracy::kThinPlate) s[random.below(3)] = kThin * random.between(0.5, 1.0);
  if (form == Degeneracy::kNeedle) {
    const std::uint32_t along = random.below(3);
    for (std::uint32_t k = 0; k < 3; ++k)
      if (k != along) s[k] = kThin * random.between(0.5, 1.0);
  }
  return s;
}

// Rounds to a grid on which sums and halves are exact in float.
constexpr double kGrid_m = 1.0 / 256.0;
double on_grid(double m) {
  return kGrid_m * std::round(m / kGrid_m);
}

core::Result<core::Mesh> shape(PairKind kind, Degeneracy form, RandomStream& random, std::uint64_t seed) {
  std::array<double, 3> s = sides(random, form);
  if (kind == PairKind::kKissing)
    for (double& side : s) side = on_grid(side);
  switch (kind) {
    case PairKind::kBoxes:
    case PairKind::kKissing:
      return datasets::box_mesh(s, {1, 1, 1});
    case PairKind::kSpheres:
      return datasets::sphere_mesh(0.5 * s[0], 8);
    case PairKind::kCapsules:
      return datasets::capsule_mesh(form == Degeneracy::kNeedle ? kThin * random.between(0.25, 0.5) : 0.25 * s[0],
                                    0.5 * random.between(0.3, 1.0), 8);
    case PairKind::kConvex:
      return datasets::convex_mesh(s, 10, seed);
    case PairKind::kMeshes: {
      auto mesh = datasets::lumpy_mesh(320, seed);
      if (!mesh) return mesh;
      core::Mesh scaled = std::move(mesh).value();
      const core::Box box = core::bounds(scaled);
      for (Vec3& v : scaled.vertices)
        for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(v[k] * s[k] / (box.max[k] - box.min[k]));
      return scaled;
    }
  }
  return core::Error{"no such kind of pairs", "agree", "", core::Exit::kInternal};
}

bool has_form(PairKind kind, Degeneracy form) {
  if (form == Degeneracy::kNone) return true;
  if (kind == PairKind::kSpheres || kind == PairKind::kKissing) return false;
  return kind != PairKind::kCapsules || form == Degeneracy::kNeedle;
}

}  // namespace

struct PairSource::Draw {
  RandomStream random;

  Point direction() {
    const auto d = random.direction();
    return {d.x, d.y, d.z};
  }
  // Evenly distributed in the logarithm.
  double logarithmic(double low, double high) {
    const double share = random.unit();
    return low * std::pow(high / low, share);
  }
};

core::Status PairSource::add(core::Result<core::Mesh> made) {
  if (!made) return made.error();
  auto mesh = std::make_shared<const core::Mesh>(std::move(made).value());
  double reach = 0.0;
  for (const Vec3 v : mesh->vertices) reach = std::max(reach, std::sqrt(dot(exact::to_point(v), exact::to_point(v))));
  const Vec3 size = core::bounds(*mesh).max - core::bounds(*mesh).min;
  if (is_convex_) {
    auto core = exact::convex_core_of(*mesh);
    if (!core) return core::Error{"mesh '" + mesh->name + "' is not convex", "agree", "", core::Exit::kInternal};
    cores_.push_back(std::move(*core));
  }
  meshes_.push_back(std::move(mesh));
  reach_m_.push_back(reach);
  least_half_m_.push_back(0.5 * std::min({size.x, size.y, size.z}));
  return core::Done{};
}

core::Status PairSource::add_shapes(const std::string& mesh) {
  if (!mesh.empty()) {
    auto acquired = datasets::acquire_mesh(mesh, datasets::MeshOptions::from_environment());
    if (!acquired) return acquired.error();
    general_ = 1;
    return add(core::normalized(std::move(acquired).value(), 1.0F));
  }
  RandomStream random(core::splitmix64(seed_ ^ static_cast<std::uint64_t>(kind_)));
  for (const Degeneracy form : {Degeneracy::kNone, Degeneracy::kThinPlate, Degeneracy::kNeedle}) {
    std::uint32_t& count = form == Degeneracy::kNone ? general_ : form == Degeneracy::kThinPlate ? plates_ : needles_;
    if (!has_form(kind_, form)) continue;
    for (int k = 0; k < (form == Degeneracy::kNone ? kShapes : kShapes / 3); ++k, ++count)
      if (core::Status s = add(shape(kind_, form, random, random.bits() >> 1)); !s) return s;
  }
  return core::Done{};
}

core::Result<PairSource> PairSource::make(PairKind kind, std::uint64_t seed, const std::string& mesh) {
  PairSource source;
  source.kind_ = kind;
  source.seed_ = seed;
  source.is_convex_ = kind != PairKind::kMeshes;
  if (core::Status s = source.add_shapes(mesh); !s) return s.error();
  return source;
}

core::Result<PairSource> PairSource::of_case(const std::vector<std::shared_ptr<const core::Mesh>>& meshes,
                                             bool is_convex) {
  PairSource source;
  source.is_convex_ = is_convex;
  for (const auto& mesh : meshes)
    if (core::Status s = source.add(*mesh); !s) return s.error();
  return source;
}

TestPair PairSource::pair(std::uint64_t index) {
  Draw draw{RandomStream(core::splitmix64(seed_ ^ core::splitmix64(index + 1)))};
  TestPair pair;
  // Two fifths are general pairs; the rest is spread evenly over the degeneracies that this kind has.
  const std::uint32_t lot = draw.random.below(20);
  if (lot >= 8) pair.degeneracy = static_cast<Degeneracy>(1 + (lot - 8) / 3);
  const std::uint32_t special = pair.degeneracy == Degeneracy::kThinPlate ? plates_
                                : pair.degeneracy == Degeneracy::kNeedle  ? needles_
                                                                          : 0;
  const bool is_form = pair.degeneracy == Degeneracy::kThinPlate || pair.degeneracy == Degeneracy::kNeedle;
  const bool has_faces = kind_ == PairKind::kBoxes || kind_ == PairKind::kConvex;
  if (kind_ == PairKind::kKissing || (is_form && special == 0) ||
      (pair.degeneracy == Degeneracy::kParallelFaces && !has_faces))
    pair.degeneracy = Degeneracy::kNone;
  const std::uint32_t first = pair.degeneracy == Degeneracy::kNeedle ? general_ + plates_ : general_;
  pair.mesh_a = special > 0 ? first + draw.random.below(special) : draw.random.below(general_);
  pair.mesh_b = pair.degeneracy == Degeneracy::kParallelFaces ? pair.mesh_a : draw.random.below(general_);
  const auto turn = [&] {
    if (is_convex_) return random_orientation(draw.random);
    RandomStream few(core::splitmix64(seed_ ^ (0x717561ULL + draw.random.below(kOrientations))));
    return random_orientation(few);
  };
  pair.pose_a.orientation = turn();
  pair.pose_b.orientation = pair.degeneracy == Degeneracy::kParallelFaces ? pair.pose_a.orientation : turn();
  if (kind_ == PairKind::kKissing && index % 3 == 0) pair.pose_a.orientation = pair.pose_b.orientation = Quat{};
  if (kind_ == PairKind::kKissing && index % 3 == 1) pair.pose_b.orientation = pair.pose_a.orientation;
  pair.pose_a.position = to_core(draw.random.between(0.0, 2.0) * draw.direction());
  if (kind_ == PairKind::kKissing)
    for (int k = 0; k < 3; ++k) pair.pose_a.position[k] = static_cast<float>(on_grid(pair.pose_a.position[k]));
  place(pair, draw, index);
  arbitrate(pair);
  return pair;
}

// B moves away from A along a random direction, or across a face of A, until it is at the separation that was drawn.
void PairSource::place(TestPair& pair, Draw& draw, std::uint64_t index) {
  pair.pose_b.position = pair.pose_a.position;
  if (pair.degeneracy == Degeneracy::kCoincidentCenters) return;
  const double s = std::min(least_half_m_[pair.mesh_a], least_half_m_[pair.mesh_b]);
  double target = 0.0;
  switch (static_cast<Separated>(index % 5)) {
    case Separated::kDeep:
      target = -draw.random.between(0.25, 1.0) * s;
      break;
    case Separated::kShallow:
      target = -draw.logarithmic(kTouchingBand_m, 0.25 * s);
      break;
    case Separated::kTouching:
      target = draw.random.between(-kTouchingBand_m, kTouchingBand_m);
      break;
    case Separated::kNear:
      target = draw.logarithmic(kTouchingBand_m, s);
      break;
    case Separated::kFar:
      target = draw.random.between(s, 4.0);
      break;
  }
  if (kind_ == PairKind::kKissing) target = 0.0;
  Point along = draw.direction();
  Point offset{};
  const bool is_aligned =
      pair.degeneracy == Degeneracy::kParallelFaces || (kind_ == PairKind::kKissing && index % 3 != 2);
  if (is_aligned) {
    const auto axis = static_cast<int>(draw.random.below(3));
    along = exact::to_point(core::rotate(pair.pose_a.orientation, core::axis_vector(axis, 1.0F)));
    Vec3 beside;
    for (int k = 0; k < 3; ++k)
      if (k != axis) beside[k] = static_cast<float>(draw.random.between(-1.0, 1.0) * s);
    if (kind_ == PairKind::kKissing)
      for (int k = 0; k < 3; ++k) beside[k] = static_cast<float>(on_grid(beside[k]));
    offset = exact::to_point(core::rotate(pair.pose_a.orientation, beside));
  }
  const double t = move_to(pair, along, offset, target);
  // Boxes parallel to the axes are put on the grid (their centers on half of it), except for what rounding left of t,
  // so they touch exactly.
  if (kind_ == PairKind::kKissing && index % 3 == 0)
    pair.pose_b.position = to_core(exact::to_point(pair.pose_a.position) + offset + 0.5 * on_grid(2.0 * t) * along);
}

// Newton's method, started from outside. Along a line the signed distance of convex bodies is convex, so no step goes
// too far. Meshes only come near the target, so the separation that was reached is measured afterwards.
double PairSource::move_to(TestPair& pair, Point along, Point offset, double target) {
  double t = reach_m_[pair.mesh_a] + reach_m_[pair.mesh_b] + std::max(0.0, target);
  const Point origin = exact::to_point(pair.pose_a.position);
  // Meshes are used at whatever separation they reach, because each step costs a search of two trees.
  const double near_enough = is_convex_ ? 1e-8 : 0.1 * std::abs(target);
  for (int step = 0; step < 16; ++step) {
    pair.pose_b.position = to_core(origin + offset + t * along);
    arbitrate(pair);
    const double error = pair.distance_m - target;
    const double slope = -dot(pair.normal, along);
    if (error < near_enough || !(slope > 1e-3)) break;
    t -= error / slope;
  }
  return t;
}

const exact::TriangleTree& PairSource::tree(std::uint32_t mesh, Quat q) {
  for (std::size_t k = 0; k < trees_.size(); ++k)
    if (mesh_of_tree_[k] == mesh && trees_[k].first == q) return *trees_[k].second;
  mesh_of_tree_.push_back(mesh);
  trees_.emplace_back(q, std::make_unique<exact::TriangleTree>(*meshes_[mesh], q));
  return *trees_.back().second;
}

void PairSource::arbitrate(TestPair& pair) {
  if (is_convex_) {
    const exact::SignedDistance found = exact::signed_distance(exact::placed(cores_[pair.mesh_a], pair.pose_a),
                                                               exact::placed(cores_[pair.mesh_b], pair.pose_b));
    pair.distance_m = found.distance_m;
    pair.normal = found.normal;
  } else {
    tree(pair.mesh_a, pair.pose_a.orientation);  // builds both trees before a reference to either is taken
    const exact::TriangleTree& b = tree(pair.mesh_b, pair.pose_b.orientation);
    const exact::TriangleTree& a = tree(pair.mesh_a, pair.pose_a.orientation);
    const exact::Nearest near = exact::nearest_of_trees(a, pair.pose_a.position, b, pair.pose_b.position);
    pair.distance_m = std::sqrt(near.squared_m2);
    pair.normal = pair.distance_m > 0.0 ? (1.0 / pair.distance_m) * (near.on_a - near.on_b) : Point{};
  }
  const double s = std::min(least_half_m_[pair.mesh_a], least_half_m_[pair.mesh_b]);
  const double d = pair.distance_m;
  // Overlapping meshes have no depth here, so deep and shallow cannot be told apart.
  if (!is_convex_ && d == 0.0) {
    pair.separation = Separated::kDeep;
    return;
  }
  pair.separation = d < -0.25 * s          ? Separated::kDeep
                    : d < -kTouchingBand_m ? Separated::kShallow
                    : d <= kTouchingBand_m ? Separated::kTouching
                    : d <= s               ? Separated::kNear
                                           : Separated::kFar;
}

double PairSource::overlap_along(const TestPair& pair, Point direction) const {
  return exact::overlap_along(exact::placed(cores_[pair.mesh_a], pair.pose_a),
                              exact::placed(cores_[pair.mesh_b], pair.pose_b), direction);
}

}  // namespace broadside::bench
