#include "bench/agree/motion/body_draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "bench/agree/pairs.hpp"
#include "bench/agree/random_pose.hpp"
#include "datasets/random.hpp"

namespace broadside::bench {
namespace {

using datasets::RandomStream;
using exact::Point;
using exact::RigidMotion;

// A body whose box is thinner than this share of its length is a plate or a needle.
constexpr double kThinShape = 0.1;
// A body turns by at most this angle in a step: less than half a turn, so that its end pose shows which way it turned.
constexpr double kMostTurn_rad = 2.5;
// Steps of the bisection that finds the path on which a body just grazes another, and the share by which the final path
// then misses or hits.
constexpr int kHalvings = 20;
constexpr double kGrazing = 1e-4;

Point direction(RandomStream& random) {
  const auto d = random.direction();
  return {d.x, d.y, d.z};
}

bool is_thin(const core::Mesh& mesh) {
  const core::Vec3 size = core::bounds(mesh).max - core::bounds(mesh).min;
  return std::min({size.x, size.y, size.z}) < kThinShape * std::max({size.x, size.y, size.z});
}

PairKind pair_kind(MotionKind kind) {
  switch (kind) {
    case MotionKind::kSpheres:
      return PairKind::kSpheres;
    case MotionKind::kCapsules:
      return PairKind::kCapsules;
    case MotionKind::kConvex:
      return PairKind::kConvex;
    case MotionKind::kMeshes:
      return PairKind::kMeshes;
    default:
      return PairKind::kBoxes;
  }
}

enum Family : std::uint8_t { kStraight, kTurning, kInPlace, kFast, kThinOnes, kGrazes, kTouching, kStandstill };

}  // namespace

BodySource BodySource::of_meshes(Meshes meshes, bool are_solid) {
  BodySource source;
  source.are_solid_ = are_solid;
  for (const auto& mesh : meshes) {
    (is_thin(*mesh) ? source.thin_ : source.general_).push_back(static_cast<std::uint32_t>(source.shapes_.size()));
    source.shapes_.emplace_back(*mesh, are_solid);
  }
  if (source.thin_.empty()) source.thin_ = source.general_;
  if (source.general_.empty()) source.general_ = source.thin_;
  source.meshes_ = std::move(meshes);
  return source;
}

core::Result<BodySource> BodySource::make(MotionKind kind, std::uint64_t seed, const std::string& mesh) {
  auto pairs = PairSource::make(pair_kind(kind), seed, mesh);
  if (!pairs) return pairs.error();
  BodySource source = of_meshes(pairs.value().meshes(), kind != MotionKind::kMeshes);
  source.seed_ = seed ^ core::splitmix64(0x6d6f74696f6eULL + static_cast<std::uint64_t>(kind));
  return source;
}

void BodySource::arbitrate(MotionTest& test) const {
  const exact::RigidTouch found =
      exact::first_touch(shapes_[test.a.mesh], test.a.motion, shapes_[test.b.mesh], test.b.motion);
  test.truth = {found.meeting == exact::Meeting::kApart   ? MotionTruth::Kind::kApart
                : found.meeting == exact::Meeting::kTouch ? MotionTruth::Kind::kTouch
                                                          : MotionTruth::Kind::kUndecided,
                found.lower, found.upper, false};
}

MotionTest BodySource::test(std::uint64_t index) const {
  RandomStream random(core::splitmix64(seed_ ^ core::splitmix64(index + 1)));
  MotionTest test;
  test.family = static_cast<std::uint8_t>(index % std::size(kBodyFamilies));
  const auto pick = [&](const std::vector<std::uint32_t>& from) {
    return from[random.below(static_cast<std::uint32_t>(from.size()))];
  };
  test.a.mesh = pick(test.family == kThinOnes ? thin_ : general_);
  test.b.mesh = pick(general_);
  const double reach = reach_m(test.a.mesh) + reach_m(test.b.mesh);
  RigidMotion& a = test.a.motion;
  RigidMotion& b = test.b.motion;
  a.start.orientation = random_orientation(random);
  b.start.orientation = random_orientation(random);
  const Point at = random.between(0.0, 2.0) * direction(random);
  const Point way = direction(random);  // from A to B
  Point beside = cross(way, direction(random));
  beside = (1.0 / std::max(length(beside), 1e-3)) * beside;
  const bool stays = test.family == kInPlace || test.family == kStandstill;
  const double apart = reach * (stays ? random.between(0.2, 1.1) : random.between(1.01, 3.0));
  a.start.position = to_core(at);
  b.start.position = to_core(at + apart * way);
  if (test.family == kTurning || test.family == kInPlace || (test.family == kThinOnes && random.below(2) == 0)) {
    a.rotation_rad = random.between(0.0, kMostTurn_rad) * direction(random);
    b.rotation_rad = random.between(0.0, kMostTurn_rad) * direction(random);
  }
  if (!stays) {
    const double speed = test.family == kFast ? random.between(50.0, 500.0) * reach : random.between(0.5, 2.0) * apart;
    a.displacement_m = random.between(0.0, 1.0) * direction(random);
    b.displacement_m = a.displacement_m - speed * way + random.between(0.0, 1.0) * reach * beside;
  }
  if (test.family == kGrazes) graze(test, beside, reach);
  if (test.family == kTouching) {
    // Starts at the positions where the arbiter sees the bodies touch, as exactly as floats can hold them.
    arbitrate(test);
    a.start.position = to_core(exact::to_point(a.start.position) + test.truth.lower * a.displacement_m);
    b.start.position = to_core(exact::to_point(b.start.position) + test.truth.lower * b.displacement_m);
    if (random.below(2) == 0) b.displacement_m = a.displacement_m + reach * direction(random);
  }
  arbitrate(test);
  return test;
}

// Shifts B's displacement sideways until B just touches A, and then by a hair more or less.
void BodySource::graze(MotionTest& test, Point beside, double gap_m) const {
  const Point straight = test.b.motion.displacement_m;
  double hits = 0.0;
  double passes = 8.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (hits + passes);
    test.b.motion.displacement_m = straight + middle * gap_m * beside;
    arbitrate(test);
    (test.truth.kind == MotionTruth::Kind::kApart ? passes : hits) = middle;
  }
  const double share = test.a.mesh % 2 == 0 ? 1.0 + kGrazing : 1.0 - kGrazing;
  test.b.motion.displacement_m = straight + share * hits * gap_m * beside;
}

}  // namespace broadside::bench
