// Where two frames first differ: one definition for everything that compares traces.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/trace/columns.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

// One number of a frame, as it is in the file.
struct FieldNumber {
  Element element = Element::kU64;
  std::uint64_t bits = 0;  // the element's bits; the rest are zero

  [[nodiscard]] double value() const;
  // Enough digits to identify the number exactly: 9 for a float, 17 for a double.
  [[nodiscard]] std::string text() const;
};

// ulps_between for floating point; the difference for whole numbers.
std::uint64_t ulps_between(const FieldNumber& a, const FieldNumber& b);

enum class DifferenceKind : std::uint8_t {
  kValue,    // both frames have the number, with different bits
  kOnlyInA,  // the record (a body's state, a pair, a contact) is in the first frame alone
  kOnlyInB,
  kOrder,  // the same pairs, or points of the same bodies, in another order
};

struct FrameDifference {
  DifferenceKind kind = DifferenceKind::kValue;
  std::string_view field;     // path in the file, "/trace/body/position"; static storage
  std::uint64_t record = 0;   // row within the frame
  std::uint32_t width = 1;    // numbers in that row
  std::uint32_t element = 0;  // which of these numbers
  std::uint32_t body_count = 0;
  std::array<std::uint32_t, 2> bodies{};  // faces of the domain as kFirstFace + k
  FieldNumber a;                          // kValue only
  FieldNumber b;

  // "x", or "min.y", for a vector or box; "" for a single number.
  [[nodiscard]] std::string_view element_name() const;
};

// What is compared besides the fields of the groups.
enum class Bookkeeping : std::uint8_t {
  kIgnored,
  kCounts,          // time, and for pairs the demanded and raw counts
  kCountsAndDigest  // and the digest
};

// Called for each number, pair or contact that differs: true accepts the difference.
using DifferenceFilter = std::function<bool(const FrameDifference&)>;

// The first difference in bits, in the order of the pipeline, so that it is nearest to its cause: octrees of the
// shapes, detection, scene octree, candidate pairs, confirmed pairs and proximities, contacts in their order of
// application, states at the end, separations, and last the bookkeeping. Only the requested groups are compared. Pairs
// are compared as sets before their order is compared.
std::optional<FrameDifference> first_difference(const FrameRecord& a, const FrameRecord& b, std::uint32_t groups,
                                                Bookkeeping bookkeeping, const DifferenceFilter& passes = {});

}  // namespace broadside::core
