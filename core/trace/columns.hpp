// The one table of the datasets under /trace: where each is in the file and in a FrameRecord. Both writer and reader
// follow it, and a test compares SCHEMA.md with it.
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
  kOffsets,      // [F + 1], starts with 0, never decreases
  kWindows,      // [W]: one row per window of the statistics
};

// The arrays of a FrameRecord (and the statistics) from which columns are written.
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
  bool is_optional = false;  // a file may lack it; its fields then keep their defaults
};

// In the order in which they are written to the file.
std::span<const Column> columns();

// The HDF5 object whose presence says that the trace has the Group: the HDF5 group that holds its datasets, or, where
// the Group is a single dataset in another Group's HDF5 group, that dataset.
struct GroupRow {
  Group group;
  std::string_view path;
  bool is_dataset = false;
};
// Without kWideBodies, which replaces kBodies when its datasets are float64.
std::span<const GroupRow> group_rows();

// There is one separation per measured pair, so these two share offsets; every other array of rows has its own.
constexpr Records offsets_of(Records r) {
  return r == Records::kSeparations ? Records::kMeasured : r;
}

constexpr std::size_t row_bytes(const Column& c) {
  return c.width * size_of(c.element);
}

// A view of count records that are stride bytes apart.
template <typename Byte>
struct RecordSpan {
  Byte* data;
  std::size_t count;
  std::size_t stride;
};

// Accepts any array except kStatistics.
RecordSpan<const std::byte> records_of(const FrameRecord& frame, Records which);
// The same array after it was resized to count records. Single values (step, time ...) have one record whatever count
// is.
RecordSpan<std::byte> resized_records(FrameRecord& frame, Records which, std::size_t count);

}  // namespace broadside::core
