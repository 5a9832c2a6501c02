#include "core/trace/columns.hpp"

#include <array>
#include <type_traits>

#include "core/trace/statistics.hpp"

namespace broadside::core {
namespace {

using enum Element;
using enum Layout;

constexpr std::uint32_t kNoGroup = 0;
constexpr std::uint32_t kOfBodies = bit(Group::kBodies);
constexpr std::uint32_t kOfDetection = bit(Group::kDetection);
constexpr std::uint32_t kOfPairs = bit(Group::kPairs);
constexpr std::uint32_t kOfConfirmed = bit(Group::kConfirmed);
constexpr std::uint32_t kOfContacts = bit(Group::kContacts);
constexpr std::uint32_t kOfNarrow = bit(Group::kNarrow);
constexpr std::uint32_t kOfOctree = bit(Group::kOctree);
constexpr std::uint32_t kOfWideBodies = bit(Group::kWideBodies);
constexpr std::uint32_t kOfDetectedOrientation = bit(Group::kDetectedOrientation);
constexpr std::uint32_t kOfPoints = bit(Group::kPoints);
constexpr std::uint32_t kOfPartPoses = bit(Group::kPartPoses);
constexpr std::uint32_t kOfBodyOctree = bit(Group::kBodyOctree);

constexpr std::size_t in_contact(std::size_t kinematics, std::size_t field) {
  return kinematics + field;
}
constexpr std::size_t kX = offsetof(Kinematics, x);
constexpr std::size_t kV = offsetof(Kinematics, v);
using Stat = PenetrationStatistics;

constexpr std::array kColumns{
    Column{"/trace/step", kNoGroup, kFrames, kU64, 1, Records::kStep, 0, "1"},
    Column{"/trace/time", kNoGroup, kFrames, kF64, 1, Records::kTime, 0, "s"},
    Column{"/trace/digest", kNoGroup, kFrames, kU64, 1, Records::kDigest, 0, "1"},

    Column{"/trace/body/position", kOfBodies, kFrameBodies, kF32, 3, Records::kPosition, 0, "m"},
    Column{"/trace/body/orientation", kOfBodies, kFrameBodies, kF32, 4, Records::kOrientation, 0, "1"},
    Column{"/trace/body/velocity", kOfBodies, kFrameBodies, kF32, 3, Records::kVelocity, 0, "m/s"},
    Column{"/trace/body/angular_velocity", kOfBodies, kFrameBodies, kF32, 3, Records::kAngularVelocity, 0, "rad/s"},

    Column{"/trace/body/position", kOfWideBodies, kFrameBodies, kF64, 3, Records::kWidePosition, 0, "m"},
    Column{"/trace/body/orientation", kOfWideBodies, kFrameBodies, kF64, 4, Records::kWideOrientation, 0, "1"},
    Column{"/trace/body/velocity", kOfWideBodies, kFrameBodies, kF64, 3, Records::kWideVelocity, 0, "m/s"},
    Column{"/trace/body/angular_velocity", kOfWideBodies, kFrameBodies, kF64, 3, Records::kWideAngularVelocity, 0,
           "rad/s"},

    Column{"/trace/detection/position", kOfDetection, kFrameBodies, kF32, 3, Records::kDetectedPosition, 0, "m"},
    Column{"/trace/detection/velocity", kOfDetection, kFrameBodies, kF32, 3, Records::kDetectedVelocity, 0, "m/s"},
    Column{"/trace/detection/boxes", kOfDetection, kFrameBodies, kF32, 6, Records::kBoxes, 0, "m"},

    Column{"/trace/detection/orientation", kOfDetectedOrientation, kFrameBodies, kF32, 4, Records::kDetectedOrientation,
           0, "1"},

    Column{"/trace/pairs/pairs", kOfPairs, kRows, kU32, 2, Records::kPairs, 0, "1"},
    Column{"/trace/pairs/offsets", kOfPairs, kOffsets, kU64, 1, Records::kPairs, 0, "1"},
    Column{"/trace/pairs/demanded", kOfPairs, kFrames, kU64, 1, Records::kDemanded, 0, "1"},
    Column{"/trace/pairs/raw", kOfPairs, kFrames, kU64, 1, Records::kRaw, 0, "1"},

    Column{"/trace/confirmed/pairs", kOfConfirmed, kRows, kU32, 2, Records::kConfirmed, 0, "1"},
    Column{"/trace/confirmed/offsets", kOfConfirmed, kOffsets, kU64, 1, Records::kConfirmed, 0, "1"},
    Column{"/trace/confirmed/squared_distance", kOfConfirmed, kRows, kF32, 1, Records::kProximity,
           offsetof(Proximity, squared_distance_m2), "m^2"},
    Column{"/trace/confirmed/vertex_a", kOfConfirmed, kRows, kU32, 1, Records::kProximity,
           offsetof(Proximity, vertex_a), "1"},
    Column{"/trace/confirmed/vertex_b", kOfConfirmed, kRows, kU32, 1, Records::kProximity,
           offsetof(Proximity, vertex_b), "1"},
    Column{"/trace/confirmed/proximity_offsets", kOfConfirmed, kOffsets, kU64, 1, Records::kProximity, 0, "1"},

    Column{"/trace/contact/a", kOfContacts, kRows, kU32, 1, Records::kContacts, offsetof(Contact, a), "1"},
    Column{"/trace/contact/b", kOfContacts, kRows, kU32, 1, Records::kContacts, offsetof(Contact, b), "1"},
    Column{"/trace/contact/color", kOfContacts, kRows, kU32, 1, Records::kContacts, offsetof(Contact, color), "1"},
    Column{"/trace/contact/depth", kOfContacts, kRows, kF32, 1, Records::kContacts, offsetof(Contact, depth_m), "m"},
    Column{"/trace/contact/normal", kOfContacts, kRows, kF32, 3, Records::kContacts, offsetof(Contact, normal), "1"},
    Column{"/trace/contact/normal_impulse", kOfContacts, kRows, kF32, 1, Records::kContacts,
           offsetof(Contact, normal_impulse_n_s), "N s"},
    Column{"/trace/contact/tangent", kOfContacts, kRows, kF32, 3, Records::kContacts, offsetof(Contact, tangent), "1"},
    Column{"/trace/contact/tangent_impulse", kOfContacts, kRows, kF32, 1, Records::kContacts,
           offsetof(Contact, tangent_impulse_n_s), "N s"},
    Column{"/trace/contact/pre_position_a", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, pre_a), kX), "m"},
    Column{"/trace/contact/pre_velocity_a", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, pre_a), kV), "m/s"},
    Column{"/trace/contact/pre_position_b", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, pre_b), kX), "m"},
    Column{"/trace/contact/pre_velocity_b", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, pre_b), kV), "m/s"},
    Column{"/trace/contact/post_position_a", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, post_a), kX), "m"},
    Column{"/trace/contact/post_velocity_a", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, post_a), kV), "m/s"},
    Column{"/trace/contact/post_position_b", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, post_b), kX), "m"},
    Column{"/trace/contact/post_velocity_b", kOfContacts, kRows, kF32, 3, Records::kContacts,
           in_contact(offsetof(Contact, post_b), kV), "m/s"},
    Column{"/trace/contact/offsets", kOfContacts, kOffsets, kU64, 1, Records::kContacts, 0, "1"},

    Column{"/trace/point/a", kOfPoints, kRows, kU32, 1, Records::kPoints, offsetof(ContactPoint, a), "1"},
    Column{"/trace/point/b", kOfPoints, kRows, kU32, 1, Records::kPoints, offsetof(ContactPoint, b), "1"},
    Column{"/trace/point/point", kOfPoints, kRows, kF32, 3, Records::kPoints, offsetof(ContactPoint, point), "m"},
    Column{"/trace/point/normal", kOfPoints, kRows, kF32, 3, Records::kPoints, offsetof(ContactPoint, normal), "1"},
    Column{"/trace/point/gap", kOfPoints, kRows, kF32, 1, Records::kPoints, offsetof(ContactPoint, gap_m), "m"},
    Column{"/trace/point/impulse", kOfPoints, kRows, kF32, 3, Records::kPoints, offsetof(ContactPoint, impulse), "N s"},
    Column{"/trace/point/feature", kOfPoints, kRows, kU32, 1, Records::kPoints, offsetof(ContactPoint, feature), "1",
           true},
    Column{"/trace/point/parts", kOfPoints, kFrames, kU32, 1, Records::kParts, 0, "1", true},
    Column{"/trace/point/offsets", kOfPoints, kOffsets, kU64, 1, Records::kPoints, 0, "1"},

    Column{"/trace/part/position", kOfPartPoses, kRows, kF32, 3, Records::kPartPoses, offsetof(PartPose, position),
           "m"},
    Column{"/trace/part/orientation", kOfPartPoses, kRows, kF32, 4, Records::kPartPoses,
           offsetof(PartPose, orientation), "1"},
    Column{"/trace/part/offsets", kOfPartPoses, kOffsets, kU64, 1, Records::kPartPoses, 0, "1"},

    Column{"/trace/narrow/pairs", kOfNarrow, kRows, kU32, 2, Records::kMeasured, 0, "1"},
    Column{"/trace/narrow/distance", kOfNarrow, kRows, kF64, 1, Records::kSeparations, offsetof(Separation, distance_m),
           "m"},
    Column{"/trace/narrow/touching", kOfNarrow, kRows, kU8, 1, Records::kSeparations, offsetof(Separation, is_touching),
           "1"},
    Column{"/trace/narrow/normal", kOfNarrow, kRows, kF32, 3, Records::kSeparations, offsetof(Separation, normal), "1"},
    Column{"/trace/narrow/witness_a", kOfNarrow, kRows, kF32, 3, Records::kSeparations, offsetof(Separation, witness_a),
           "m"},
    Column{"/trace/narrow/witness_b", kOfNarrow, kRows, kF32, 3, Records::kSeparations, offsetof(Separation, witness_b),
           "m"},
    Column{"/trace/narrow/offsets", kOfNarrow, kOffsets, kU64, 1, Records::kMeasured, 0, "1"},

    Column{"/trace/octree/box", kOfOctree, kRows, kF32, 6, Records::kOctreeNodes, offsetof(OctreeNode, box), "m"},
    Column{"/trace/octree/level", kOfOctree, kRows, kU32, 1, Records::kOctreeNodes, offsetof(OctreeNode, level), "1"},
    Column{"/trace/octree/parent", kOfOctree, kRows, kU32, 1, Records::kOctreeNodes, offsetof(OctreeNode, parent), "1"},
    Column{"/trace/octree/first_child", kOfOctree, kRows, kU32, 1, Records::kOctreeNodes,
           offsetof(OctreeNode, first_child), "1"},
    Column{"/trace/octree/child_count", kOfOctree, kRows, kU32, 1, Records::kOctreeNodes,
           offsetof(OctreeNode, child_count), "1"},
    Column{"/trace/octree/node_offsets", kOfOctree, kOffsets, kU64, 1, Records::kOctreeNodes, 0, "1"},
    Column{"/trace/octree/node_of_body", kOfOctree, kFrameBodies, kU32, 1, Records::kOctreeNodeOfBody, 0, "1"},

    Column{"/trace/body_octree/shape", kOfBodyOctree, kRows, kU32, 1, Records::kShapeOfBody, 0, "1"},
    Column{"/trace/body_octree/shape_offsets", kOfBodyOctree, kOffsets, kU64, 1, Records::kShapeOfBody, 0, "1"},
    Column{"/trace/body_octree/box", kOfBodyOctree, kRows, kF32, 6, Records::kBodyOctreeBoxes, 0, "m"},
    Column{"/trace/body_octree/box_offsets", kOfBodyOctree, kOffsets, kU64, 1, Records::kBodyOctreeBoxes, 0, "1"},
    Column{"/trace/body_octree/leaf", kOfBodyOctree, kRows, kU32, 1, Records::kLeafOfVertex, 0, "1"},
    Column{"/trace/body_octree/leaf_offsets", kOfBodyOctree, kOffsets, kU64, 1, Records::kLeafOfVertex, 0, "1"},

    Column{"/trace/statistics/first_step", kOfContacts, kWindows, kU64, 1, Records::kStatistics,
           offsetof(Stat, first_step), "1"},
    Column{"/trace/statistics/last_step", kOfContacts, kWindows, kU64, 1, Records::kStatistics,
           offsetof(Stat, last_step), "1"},
    Column{"/trace/statistics/frames", kOfContacts, kWindows, kU64, 1, Records::kStatistics, offsetof(Stat, frames),
           "1"},
    Column{"/trace/statistics/body_contacts", kOfContacts, kWindows, kU64, 1, Records::kStatistics,
           offsetof(Stat, body_contacts), "1"},
    Column{"/trace/statistics/face_contacts", kOfContacts, kWindows, kU64, 1, Records::kStatistics,
           offsetof(Stat, face_contacts), "1"},
    Column{"/trace/statistics/mean_depth", kOfContacts, kWindows, kF64, 1, Records::kStatistics,
           offsetof(Stat, mean_depth_m), "m"},
    Column{"/trace/statistics/largest_depth", kOfContacts, kWindows, kF64, 1, Records::kStatistics,
           offsetof(Stat, largest_depth_m), "m"},
    Column{"/trace/statistics/share_above_slop", kOfContacts, kWindows, kF64, 1, Records::kStatistics,
           offsetof(Stat, share_above_slop), "1"},
};

constexpr std::array kGroupRows{
    GroupRow{Group::kBodies, "/trace/body"},
    GroupRow{Group::kDetection, "/trace/detection"},
    GroupRow{Group::kPairs, "/trace/pairs"},
    GroupRow{Group::kConfirmed, "/trace/confirmed"},
    GroupRow{Group::kContacts, "/trace/contact"},
    GroupRow{Group::kNarrow, "/trace/narrow"},
    GroupRow{Group::kOctree, "/trace/octree"},
    GroupRow{Group::kBodyOctree, "/trace/body_octree"},
    GroupRow{Group::kPoints, "/trace/point"},
    GroupRow{Group::kPartPoses, "/trace/part"},
    GroupRow{Group::kDetectedOrientation, "/trace/detection/orientation", true},
};

static_assert(sizeof(Vec3) == 12 && sizeof(Quat) == 16 && sizeof(Box) == 24 && sizeof(WideVec3) == 24 &&
                  sizeof(WideQuat) == 32 && sizeof(Pair) == 8 && sizeof(bool) == 1,
              "rows are copied as they lie in memory");

// The only place that maps an enumerator to its member. visit gets a vector or a single value.
template <typename Frame, typename Visit>
auto visit_records(Frame& f, Records which, Visit visit) {
  switch (which) {
    case Records::kTime:
      return visit(f.time_s);
    case Records::kDigest:
      return visit(f.digest);
    case Records::kPosition:
      return visit(f.position);
    case Records::kOrientation:
      return visit(f.orientation);
    case Records::kVelocity:
      return visit(f.velocity);
    case Records::kAngularVelocity:
      return visit(f.angular_velocity);
    case Records::kDetectedPosition:
      return visit(f.detected_position);
    case Records::kDetectedVelocity:
      return visit(f.detected_velocity);
    case Records::kBoxes:
      return visit(f.boxes);
    case Records::kPairs:
      return visit(f.pairs);
    case Records::kDemanded:
      return visit(f.pairs_demanded);
    case Records::kRaw:
      return visit(f.pairs_raw);
    case Records::kParts:
      return visit(f.parts);
    case Records::kConfirmed:
      return visit(f.confirmed);
    case Records::kProximity:
      return visit(f.proximity);
    case Records::kContacts:
      return visit(f.contacts);
    case Records::kMeasured:
      return visit(f.measured);
    case Records::kSeparations:
      return visit(f.separations);
    case Records::kOctreeNodes:
      return visit(f.octree_nodes);
    case Records::kOctreeNodeOfBody:
      return visit(f.octree_node_of_body);
    case Records::kShapeOfBody:
      return visit(f.shape_of_body);
    case Records::kBodyOctreeBoxes:
      return visit(f.body_octree_boxes);
    case Records::kLeafOfVertex:
      return visit(f.leaf_of_vertex);
    case Records::kWidePosition:
      return visit(f.wide.position);
    case Records::kWideOrientation:
      return visit(f.wide.orientation);
    case Records::kWideVelocity:
      return visit(f.wide.velocity);
    case Records::kWideAngularVelocity:
      return visit(f.wide.angular_velocity);
    case Records::kDetectedOrientation:
      return visit(f.detected_orientation);
    case Records::kPoints:
      return visit(f.points);
    case Records::kPartPoses:
      return visit(f.part_poses);
    case Records::kStep:
    case Records::kStatistics:
      break;
  }
  return visit(f.step);
}

}  // namespace

std::span<const Column> columns() {
  return kColumns;
}

std::span<const GroupRow> group_rows() {
  return kGroupRows;
}

RecordSpan<const std::byte> records_of(const FrameRecord& frame, Records which) {
  return visit_records(frame, which, [](const auto& member) -> RecordSpan<const std::byte> {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>)
      return {reinterpret_cast<const std::byte*>(&member), 1, sizeof member};
    else
      return {reinterpret_cast<const std::byte*>(member.data()), member.size(), sizeof member[0]};
  });
}

RecordSpan<std::byte> resized_records(FrameRecord& frame, Records which, std::size_t count) {
  return visit_records(frame, which, [count](auto& member) -> RecordSpan<std::byte> {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>) {
      return {reinterpret_cast<std::byte*>(&member), 1, sizeof member};
    } else {
      member.resize(count);
      return {reinterpret_cast<std::byte*>(member.data()), count, sizeof member[0]};
    }
  });
}

}  // namespace broadside::core
