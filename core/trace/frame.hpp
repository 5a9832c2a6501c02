// One frame of a trace in memory: the record of one step.
#pragma once

#include <cstdint>
#include <vector>

#include "core/contact.hpp"
#include "core/contact_point.hpp"
#include "core/engine/narrow_phase.hpp"
#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/math/wide.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/scene/octree_node.hpp"

namespace broadside::core {

enum class RecordLevel { kFull, kDigest, kNone };

// Groups of a frame; a trace has each group in all of its frames or in none.
enum class Group : std::uint32_t {
  kBodies = 1U << 0,      // states at the end of the step
  kDetection = 1U << 1,   // states and boxes that collision detection saw: after integration, before any response
  kPairs = 1U << 2,       // candidate pairs of the broad phase
  kConfirmed = 1U << 3,   // pairs whose body-octree boxes overlap at the last level, and their vertex proximity
  kContacts = 1U << 4,    // every application of the response, in the order of application
  kNarrow = 1U << 5,      // separations measured by a narrow-phase engine
  kOctree = 1U << 6,      // the scene octree, and the node that each body is stored in
  kBodyOctree = 1U << 7,  // the octrees over the shapes' vertices, recorded once, with the first frame
  kDetectedOrientation = 1U << 8,  // orientations that collision detection saw, for engines whose bodies turn
  kPoints = 1U << 9,               // points of contact with the totals of the step
  kWideBodies = 1U << 10,          // the states of kBodies in float64; a trace with it has kBodies too
  kPartPoses = 1U << 11,           // where bodies were between the parts of a step
};

constexpr std::uint32_t bit(Group g) {
  return static_cast<std::uint32_t>(g);
}

// Body states in float64. n = body count.
struct WideStates {
  std::vector<WideVec3> position;  // [n] m
  std::vector<WideQuat> orientation;
  std::vector<WideVec3> velocity;          // [n] m/s
  std::vector<WideVec3> angular_velocity;  // [n] rad/s
};

// Where a body was at the end of a part of a step.
struct PartPose {
  Vec3 position;  // m
  Quat orientation;
};

// Vectors of a group that the trace does not have are empty. n = body count.
struct FrameRecord {
  std::uint64_t step = 0;  // 1 = after the first step; 0 = the initial state
  double time_s = 0.0;     // step * dt
  std::uint64_t digest = 0;

  std::vector<Vec3> position;  // [n] m
  std::vector<Quat> orientation;
  std::vector<Vec3> velocity;  // [n] m/s
  std::vector<Vec3> angular_velocity;
  WideStates wide;  // the same in float64, for kWideBodies; the vectors above then hold these numbers rounded

  std::vector<Vec3> detected_position;
  std::vector<Vec3> detected_velocity;
  std::vector<Quat> detected_orientation;
  std::vector<Box> boxes;  // [n] at detection: the exact candidate set is defined by these

  std::vector<Pair> pairs;
  std::uint64_t pairs_demanded = 0;
  std::uint64_t pairs_raw = 0;

  std::vector<Pair> confirmed;
  std::vector<Proximity> proximity;  // one per confirmed pair; empty when the vertex stage was off

  std::vector<Contact> contacts;
  std::vector<ContactPoint> points;
  std::uint32_t parts = 0;  // how many parts, each with its own points, the step was taken in; 0: unknown
  // [(parts - 1) n] poses of all bodies at the end of each part but the last, part after part
  std::vector<PartPose> part_poses;

  std::vector<Pair> measured;
  std::vector<Separation> separations;

  std::vector<OctreeNode> octree_nodes;
  std::vector<std::uint32_t> octree_node_of_body;  // [n] index into octree_nodes

  // A shape is a distinct (mesh, orientation); bodies of one shape share its octree of 1 + 8 + 64 nodes.
  std::vector<std::uint32_t> shape_of_body;  // [n]; empty in later frames
  std::vector<Box> body_octree_boxes;  // 73 per shape, relative to the body's position; min > max in empty octants
  std::vector<std::uint32_t> leaf_of_vertex;  // one per vertex of each shape's mesh, shape after shape: 0 to 63
};

}  // namespace broadside::core
