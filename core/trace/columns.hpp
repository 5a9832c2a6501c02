// The one table of the datasets under /trace: where each stands in the file and in a FrameRecord. Writer and reader
// both walk it, and SCHEMA.md is tested against it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/trace/frame.hpp"

namespace broadside::core {

enum class Element : std::uint8_t { kU8, kU32, kU64, kI64, kF32, kF64 };

constexpr std::size_t size_of(Element e) {
  return e == Element::kU8 ? 1 : (e == Element::kU32 || e == Element::kF32 ? 4 : 8);
}

// F = recorded frames, n = bodies, R = rows of all frames together; the last dimension is absent when width is 1.
enum class Layout : std::uint8_t {
  kFrames,       // [F] or [F, width]
  kFrameBodies,  // [F, n, width]
  kRows,         // [R, width]: frame k has the rows offsets[k] .. offsets[k + 1] - 1
  kOffsets,      // [F + 1], starts with 0, never falls
  kWindows,      // [W]: one row per window of the statistics
};

// The arrays of a FrameRecord (and the statistics), each a column's source.
enum class Records : std::uint8_t {
  kStep,
  kTime,
  kDigest,
  kPosition,
  kOrientation,
  kVelocity,
  kAngularVelocity,
  kDetectedPosition,
  kDetectedVelocity,
  kBoxes,
  kPairs,
  kDemanded,
  kRaw,
  kConfirmed,
  kProximity,
  kContacts,
  kMeasured,
  kSeparations,
  kOctreeNodes,
  kOctreeNodeOfBody,
  kShapeOfBody,
  kBodyOctreeBoxes,
  kLeafOfVertex,
  kStatistics,
  kWidePosition,
  kWideOrientation,
  kWideVelocity,
  kWideAngularVelocity,
  kDetectedOrientation,
  kPoints,
  kParts,
  kPartPoses,
};

struct Column {
  std::string_view path;
  std::uint32_t groups;  // bit(Group); 0 = in every trace
  Layout layout;
  Element element;
  std::uint32_t width;  // elements in a row
  Records records;
  std::size_t offset;        // of the first element in a record, bytes
  std::string_view unit;     // "1" = a pure number
  bool is_optional = false;  // a file may lack it, and then its fields keep their defaults
};

// In the order in which they are written.
std::span<const Column> columns();

// The HDF5 object whose being there says that the trace has the Group: the HDF5 group that holds its datasets, or where
// it has one dataset in another's group, that dataset.
struct GroupRow {
  Group group;
  std::string_view path;
  bool is_dataset = false;
};
// Without kWideBodies, which stands in kBodies' place when its datasets are float64.
std::span<const GroupRow> group_rows();

// Separations are one per measured pair and share its offsets; every other array of rows has offsets of its own.
constexpr Records offsets_of(Records r) {
  return r == Records::kSeparations ? Records::kMeasured : r;
}

constexpr std::size_t row_bytes(const Column& c) {
  return c.width * size_of(c.element);
}

// count records of stride bytes each.
template <typename Byte>
struct RecordSpan {
  Byte* data;
  std::size_t count;
  std::size_t stride;
};

// Any array but kStatistics.
RecordSpan<const std::byte> records_of(const FrameRecord& frame, Records which);
// The same array, given count records first. Single values (step, time ...) have one record whatever count says.
RecordSpan<std::byte> resized_records(FrameRecord& frame, Records which, std::size_t count);

}  // namespace broadside::core
