// One question of the motion study: what moves, of which family, and the arbiter's answer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/engine/motion_query.hpp"

namespace broadside::bench {

enum class MotionKind { kVertexFace, kEdgeEdge, kBoxes, kSpheres, kCapsules, kConvex, kMeshes };
inline constexpr std::string_view kMotionKinds[] = {"vertex-face", "edge-edge", "boxes", "spheres",
                                                    "capsules",    "convex",    "meshes"};
constexpr bool is_of_features(MotionKind kind) {
  return kind == MotionKind::kVertexFace || kind == MotionKind::kEdgeEdge;
}

inline constexpr std::string_view kFeatureFamilies[] = {
    "general",    "parallel",   "one plane",  "grazing",         "touching at the start",
    "standstill", "tiny units", "huge units", "far from origin", "fractions"};
inline constexpr std::string_view kBodyFamilies[] = {"straight", "turning", "turning in place",      "fast",
                                                     "thin",     "grazing", "touching at the start", "standstill"};
std::span<const std::string_view> families_of(MotionKind kind);

struct MotionTruth {
  enum class Kind : std::uint8_t { kApart, kTouch, kUndecided };
  Kind kind = Kind::kApart;
  double lower = 1.0;  // no touch before this time
  double upper = 1.0;  // the bodies touch or overlap at this time or before it
  // Whether there is a touch differs between the fractions of a query file and the doubles that engines get.
  bool rounding_decides = false;
};

// Plain bytes, because another process writes it.
struct MotionTest {
  std::uint8_t family = 0;
  continuous::MovingFeatures features;  // of the kinds vertex-face and edge-edge
  core::MovingBody a;                   // of the kinds of bodies
  core::MovingBody b;
  MotionTruth truth;
};

using Meshes = std::vector<std::shared_ptr<const core::Mesh>>;

// Computed exactly, by core/exact.
MotionTruth truth_of(const continuous::MovingFeatures& features);

// An upper bound on the speed of any point of one body relative to any point of the other, m per step.
double relative_speed_m(const MotionTest& test, double reach_a_m, double reach_b_m);

}  // namespace broadside::bench
