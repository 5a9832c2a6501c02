#include "core/trace/frame_difference.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/math/ulps.hpp"

namespace broadside::core {
namespace {

// In the order of the pipeline.
struct Stage {
  Records records;
  std::uint32_t group;  // 0: bookkeeping
};
constexpr std::array kStages{
    Stage{Records::kShapeOfBody, bit(Group::kBodyOctree)},
    Stage{Records::kBodyOctreeBoxes, bit(Group::kBodyOctree)},
    Stage{Records::kLeafOfVertex, bit(Group::kBodyOctree)},
    Stage{Records::kDetectedPosition, bit(Group::kDetection)},
    Stage{Records::kDetectedVelocity, bit(Group::kDetection)},
    Stage{Records::kBoxes, bit(Group::kDetection)},
    Stage{Records::kOctreeNodes, bit(Group::kOctree)},
    Stage{Records::kOctreeNodeOfBody, bit(Group::kOctree)},
    Stage{Records::kPairs, bit(Group::kPairs)},
    Stage{Records::kConfirmed, bit(Group::kConfirmed)},
    Stage{Records::kProximity, bit(Group::kConfirmed)},
    Stage{Records::kDetectedOrientation, bit(Group::kDetectedOrientation)},
    Stage{Records::kContacts, bit(Group::kContacts)},
    Stage{Records::kPoints, bit(Group::kPoints)},
    Stage{Records::kPartPoses, bit(Group::kPartPoses)},
    Stage{Records::kWidePosition, bit(Group::kWideBodies)},
    Stage{Records::kWideOrientation, bit(Group::kWideBodies)},
    Stage{Records::kWideVelocity, bit(Group::kWideBodies)},
    Stage{Records::kWideAngularVelocity, bit(Group::kWideBodies)},
    Stage{Records::kPosition, bit(Group::kBodies)},
    Stage{Records::kOrientation, bit(Group::kBodies)},
    Stage{Records::kVelocity, bit(Group::kBodies)},
    Stage{Records::kAngularVelocity, bit(Group::kBodies)},
    Stage{Records::kMeasured, bit(Group::kNarrow)},
    Stage{Records::kSeparations, bit(Group::kNarrow)},
};
constexpr std::array kCounts{Records::kTime, Records::kDemanded, Records::kRaw, Records::kParts};

std::vector<const Column*> columns_of(Records records) {
  std::vector<const Column*> found;
  for (const Column& c : columns())
    if (c.records == records && c.layout != Layout::kOffsets && c.layout != Layout::kWindows) found.push_back(&c);
  return found;
}

// Does not convert through a double, which would change a signaling NaN.
float as_float(const FieldNumber& n) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(n.bits));
}

FieldNumber number_at(const Column& c, const std::byte* row, std::uint32_t element) {
  FieldNumber n{c.element, 0};
  const std::size_t bytes = size_of(c.element);
  std::memcpy(&n.bits, row + c.offset + element * bytes, bytes);
  return n;
}

class Comparison {
 public:
  Comparison(const FrameRecord& a, const FrameRecord& b, const DifferenceFilter& passes)
      : a_(a), b_(b), passes_(passes) {}

  [[nodiscard]] bool found() const { return found_.has_value(); }
  std::optional<FrameDifference> take() { return found_; }

  void compare(Records records) {
    if (records == Records::kPairs) return compare_pairs(records, a_.pairs, b_.pairs);
    if (records == Records::kConfirmed) return compare_pairs(records, a_.confirmed, b_.confirmed);
    if (records == Records::kMeasured) return compare_pairs(records, a_.measured, b_.measured);
    compare_rows(records);
  }

 private:
  // Returns false when the filter accepts this difference.
  bool note(FrameDifference d) {
    if (passes_ && passes_(d)) return false;
    found_ = d;
    return true;
  }

  FrameDifference about(const Column& column, DifferenceKind kind, std::uint64_t record) const {
    FrameDifference d;
    d.kind = kind;
    d.field = column.path;
    d.record = record;
    d.width = column.width;
    name_bodies(d, column, kind == DifferenceKind::kOnlyInB ? b_ : a_);
    return d;
  }

  static void name_bodies(FrameDifference& d, const Column& column, const FrameRecord& frame) {
    const auto name = [&d](std::uint32_t i, std::uint32_t j) {
      d.bodies = {i, j};
      d.body_count = 2;
    };
    const auto name_pair = [&](const std::vector<Pair>& pairs) {
      if (d.record < pairs.size()) name(pairs[d.record].i, pairs[d.record].j);
    };
    if (column.layout == Layout::kFrameBodies) {
      d.bodies[0] = static_cast<std::uint32_t>(d.record);
      d.body_count = 1;
    } else if (column.records == Records::kContacts) {
      name(frame.contacts[d.record].a, frame.contacts[d.record].b);
    } else if (column.records == Records::kPoints) {
      name(frame.points[d.record].a, frame.points[d.record].b);
    } else if (column.records == Records::kProximity) {
      name_pair(frame.confirmed);
    } else if (column.records == Records::kSeparations) {
      name_pair(frame.measured);
    }
  }

  void compare_rows(Records records) {
    const RecordSpan<const std::byte> a = records_of(a_, records);
    const RecordSpan<const std::byte> b = records_of(b_, records);
    const std::size_t both = std::min(a.count, b.count);
    const std::vector<const Column*> fields = columns_of(records);
    // Equal bytes are equal records. Unequal ones may differ only in padding, so then each number is compared.
    if (both > 0 && std::memcmp(a.data, b.data, both * a.stride) != 0) {
      for (std::size_t k = 0; k < both; ++k)
        if (compare_record(fields, a.data + k * a.stride, b.data + k * b.stride, k)) return;
    }
    if (a.count > both) note(about(*fields.front(), DifferenceKind::kOnlyInA, both));
    if (b.count > both) note(about(*fields.front(), DifferenceKind::kOnlyInB, both));
  }

  bool compare_record(const std::vector<const Column*>& fields, const std::byte* a, const std::byte* b, std::size_t k) {
    for (const Column* c : fields) {
      for (std::uint32_t e = 0; e < c->width; ++e) {
        const FieldNumber p = number_at(*c, a, e);
        const FieldNumber q = number_at(*c, b, e);
        if (p.bits == q.bits) continue;
        FrameDifference d = about(*c, DifferenceKind::kValue, k);
        // When the bodies differ it is a different contact, so its other numbers do not matter.
        if (c->records == Records::kContacts && is_id(*c)) d.kind = kind_of_contact(a_.contacts[k]);
        if (c->records == Records::kPoints && is_point_id(*c)) d.kind = kind_of_point(a_.points[k], b_.points[k]);
        if (d.kind == DifferenceKind::kOnlyInB) name_bodies(d, *c, b_);
        d.element = e;
        d.a = p;
        d.b = q;
        if (note(d)) return true;
      }
    }
    return false;
  }

  static bool is_id(const Column& c) { return c.offset == offsetof(Contact, a) || c.offset == offsetof(Contact, b); }

  // When the other frame has this contact too, the contact at this place of the other frame is the extra one.
  DifferenceKind kind_of_contact(const Contact& c) const {
    const auto same = [&c](const Contact& o) { return o.a == c.a && o.b == c.b; };
    return std::any_of(b_.contacts.begin(), b_.contacts.end(), same) ? DifferenceKind::kOnlyInB
                                                                     : DifferenceKind::kOnlyInA;
  }

  static bool is_point_id(const Column& c) {
    return c.offset == offsetof(ContactPoint, a) || c.offset == offsetof(ContactPoint, b);
  }

  // Called when the points at one place belong to different bodies: either one frame has a point more for its bodies,
  // or both have the same points in another order.
  DifferenceKind kind_of_point(const ContactPoint& p, const ContactPoint& q) const {
    const auto count = [](const FrameRecord& frame, const ContactPoint& of) {
      return std::count_if(frame.points.begin(), frame.points.end(),
                           [&](const ContactPoint& o) { return o.a == of.a && o.b == of.b; });
    };
    if (count(a_, p) > count(b_, p)) return DifferenceKind::kOnlyInA;
    return count(b_, q) > count(a_, q) ? DifferenceKind::kOnlyInB : DifferenceKind::kOrder;
  }

  void compare_pairs(Records records, const std::vector<Pair>& a, const std::vector<Pair>& b) {
    if (a == b) return;
    const Column& column = *columns_of(records).front();
    const auto sorted = [](std::vector<Pair> list) {
      std::sort(list.begin(), list.end());
      return list;
    };
    const std::vector<Pair> p = sorted(a);
    const std::vector<Pair> q = sorted(b);
    const auto note_pair = [&](Pair pair, DifferenceKind kind, const std::vector<Pair>& list) {
      const auto at = std::find(list.begin(), list.end(), pair);
      FrameDifference d;
      d.kind = kind;
      d.field = column.path;
      d.record = static_cast<std::uint64_t>(at - list.begin());
      d.width = column.width;
      d.bodies = {pair.i, pair.j};
      d.body_count = 2;
      return note(d);
    };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < p.size() || j < q.size()) {
      if (j == q.size() || (i < p.size() && p[i] < q[j])) {
        if (note_pair(p[i++], DifferenceKind::kOnlyInA, a)) return;
      } else if (i == p.size() || q[j] < p[i]) {
        if (note_pair(q[j++], DifferenceKind::kOnlyInB, b)) return;
      } else {
        ++i, ++j;
      }
    }
    if (p != q) return;  // the filter accepted every pair that differs
    const auto moved = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
    note_pair(a[moved], DifferenceKind::kOrder, a);
  }

  const FrameRecord& a_;
  const FrameRecord& b_;
  const DifferenceFilter& passes_;
  std::optional<FrameDifference> found_;
};

}  // namespace

double FieldNumber::value() const {
  switch (element) {
    case Element::kF32:
      return as_float(*this);
    case Element::kF64:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

std::string FieldNumber::text() const {
  if (element != Element::kF32 && element != Element::kF64) return std::to_string(bits);
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", element == Element::kF32 ? 9 : 17, value());
  return text;
}

std::uint64_t ulps_between(const FieldNumber& a, const FieldNumber& b) {
  if (a.element == Element::kF32) return ulps_between(as_float(a), as_float(b));
  if (a.element == Element::kF64) return ulps_between(std::bit_cast<double>(a.bits), std::bit_cast<double>(b.bits));
  return a.bits > b.bits ? a.bits - b.bits : b.bits - a.bits;
}

std::string_view FrameDifference::element_name() const {
  static constexpr std::array<std::string_view, 6> kBox{"min.x", "min.y", "min.z", "max.x", "max.y", "max.z"};
  static constexpr std::array<std::string_view, 4> kQuat{"w", "x", "y", "z"};
  static constexpr std::array<std::string_view, 3> kVec{"x", "y", "z"};
  if (width == kBox.size()) return kBox[element];
  if (width == kQuat.size()) return kQuat[element];
  return width == kVec.size() ? kVec[element] : "";
}

std::optional<FrameDifference> first_difference(const FrameRecord& a, const FrameRecord& b, std::uint32_t groups,
                                                Bookkeeping bookkeeping, const DifferenceFilter& passes) {
  Comparison comparison(a, b, passes);
  for (const Stage& stage : kStages) {
    if ((groups & stage.group) == 0) continue;
    comparison.compare(stage.records);
    if (comparison.found()) return comparison.take();
  }
  if (bookkeeping == Bookkeeping::kIgnored) return std::nullopt;
  for (const Records records : kCounts) {
    if (records != Records::kTime && (groups & bit(Group::kPairs)) == 0) continue;
    comparison.compare(records);
    if (comparison.found()) return comparison.take();
  }
  if (bookkeeping == Bookkeeping::kCountsAndDigest) comparison.compare(Records::kDigest);
  return comparison.take();
}

}  // namespace broadside::core
