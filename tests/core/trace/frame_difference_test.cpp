// The first difference of two frames: whichever number of any dataset is changed, that number is named.
#include "core/trace/frame_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/trace/columns.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kComparedBodies = 6;

std::optional<FrameDifference> compared(const FrameRecord& a, const FrameRecord& b) {
  const std::uint32_t wide = a.wide.position.empty() ? 0U : bit(Group::kWideBodies);
  return core::first_difference(a, b, kAllGroups | wide, Bookkeeping::kCountsAndDigest);
}

// With rows in every dataset, and pairs in order.
FrameRecord full_frame() {
  Bits bits(11);
  FrameRecord f = random_frame(bits, 3, kComparedBodies, kAllGroups & ~bit(Group::kPairs));
  f.pairs = f.confirmed = f.measured = {{0, 1}, {1, 3}, {2, 4}};
  f.proximity = {{0.5F, 1, 2}, {}, {0.25F, 0, 0}};
  f.separations = {{1.0, false, {}, {}, {}}, {2.0, true, {}, {}, {}}, {3.0, false, {}, {}, {}}};
  f.contacts = {random_contact(bits, kComparedBodies), random_contact(bits, kComparedBodies),
                random_contact(bits, kComparedBodies)};
  f.contacts[1].a = 1, f.contacts[1].b = 3;
  f.pairs_demanded = f.pairs_raw = 3;
  f.octree_nodes.resize(3);
  f.octree_node_of_body.resize(kComparedBodies);
  f.shape_of_body.resize(kComparedBodies);
  f.body_octree_boxes.resize(73);
  f.leaf_of_vertex.resize(4);
  return f;
}

// States in float64 take the place of those in float32.
FrameRecord wide_frame() {
  FrameRecord f = full_frame();
  f.wide.position.assign(kComparedBodies, {1.0, 2.0, 3.0});
  f.wide.velocity.assign(kComparedBodies, {4.0, 5.0, 6.0});
  f.wide.angular_velocity.assign(kComparedBodies, {7.0, 8.0, 9.0});
  f.wide.orientation.assign(kComparedBodies, {0.5, 0.5, 0.5, 0.5});
  return f;
}

TEST(FrameDifference, IsNoneForEqualBitsEvenOfNaN) {
  FrameRecord f = full_frame();
  f.position[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(compared(f, f));
}

TEST(FrameDifference, NamesTheDatasetRowAndElementOfEveryFlippedBit) {
  const FrameRecord narrow = full_frame();
  const FrameRecord wide = wide_frame();
  int tried = 0;
  for (const Column& c : columns()) {
    if (c.layout == Layout::kOffsets || c.layout == Layout::kWindows || c.records == Records::kStep) continue;
    const bool is_pair =
        c.records == Records::kPairs || c.records == Records::kConfirmed || c.records == Records::kMeasured;
    const bool is_id = c.path == "/trace/contact/a" || c.path == "/trace/contact/b" || c.path == "/trace/point/a" ||
                       c.path == "/trace/point/b";
    if (is_pair || is_id) continue;  // other bodies make another pair: see below
    const FrameRecord& good = records_of(narrow, c.records).count > 0 ? narrow : wide;
    for (std::uint32_t e = 0; e < c.width; ++e) {
      FrameRecord bad = good;
      const std::size_t count = records_of(good, c.records).count;
      const std::size_t row = count > 1 ? 1 : 0;
      const RecordSpan<std::byte> rows = resized_records(bad, c.records, count);
      rows.data[row * rows.stride + c.offset + e * size_of(c.element)] ^= std::byte{1};
      const auto d = compared(good, bad);
      ASSERT_TRUE(d) << c.path;
      EXPECT_EQ(d->field, c.path);
      EXPECT_EQ(d->kind, DifferenceKind::kValue) << c.path;
      EXPECT_EQ(d->record, row) << c.path;
      EXPECT_EQ(d->element, e) << c.path;
      if (!std::isnan(d->a.value()) && !std::isnan(d->b.value())) {
        EXPECT_EQ(ulps_between(d->a, d->b), 1U) << c.path << ": the last bit of a little-endian number";
      }
      if (c.layout == Layout::kFrameBodies) {
        EXPECT_EQ(d->body_count, 1U);
        EXPECT_EQ(d->bodies[0], row);
      } else if (c.records == Records::kContacts || c.records == Records::kProximity ||
                 c.records == Records::kSeparations) {
        EXPECT_EQ(d->body_count, 2U) << c.path;
        EXPECT_EQ(d->bodies[0], 1U) << c.path;
        EXPECT_EQ(d->bodies[1], 3U) << c.path;
      }
      ++tried;
    }
  }
  EXPECT_GT(tried, 60);
}

TEST(FrameDifference, ComparesPairsAsSetsAndThenTheirOrder) {
  const FrameRecord a = full_frame();
  FrameRecord b = a;
  b.pairs = {{0, 1}, {2, 4}};
  auto d = compared(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOnlyInA);
  EXPECT_EQ(d->field, "/trace/pairs/pairs");
  EXPECT_EQ(d->bodies, (std::array<std::uint32_t, 2>{1, 3}));
  d = compared(b, a);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOnlyInB);
  b.pairs = {{0, 1}, {2, 4}, {1, 3}};
  d = compared(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOrder);
  EXPECT_EQ(d->record, 1U);
}

TEST(FrameDifference, OfContactsIsAnotherContactOrAMissingOne) {
  const FrameRecord a = full_frame();
  FrameRecord b = a;
  b.contacts.pop_back();
  auto d = compared(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOnlyInA);
  EXPECT_EQ(d->record, 2U);
  b = a;
  b.contacts.erase(b.contacts.begin() + 1);
  d = compared(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOnlyInA);
  EXPECT_EQ(d->bodies, (std::array<std::uint32_t, 2>{1, 3}));
  d = compared(b, a);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->kind, DifferenceKind::kOnlyInB);
  EXPECT_EQ(d->bodies, (std::array<std::uint32_t, 2>{1, 3}));
}

// In the order of the pipeline: a stage's input comes before its output.
TEST(FrameDifference, IsTheOneNearestToItsCause) {
  const FrameRecord a = full_frame();
  FrameRecord b = a;
  b.velocity[0].x += 1.0F;
  b.digest ^= 1U;
  b.boxes[5].max.z = -7.0F;
  const auto d = compared(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->field, "/trace/detection/boxes");
  EXPECT_EQ(d->element_name(), "max.z");
  EXPECT_EQ(d->bodies[0], 5U);
}

TEST(FrameDifference, PassesWhatTheFilterLetsPass) {
  const FrameRecord a = full_frame();
  FrameRecord b = a;
  b.position[0].x = 100.0F;
  b.position[1].x = 200.0F;
  const auto d = core::first_difference(a, b, kAllGroups, Bookkeeping::kIgnored,
                                        [](const FrameDifference& seen) { return seen.b.value() < 150.0; });
  ASSERT_TRUE(d);
  EXPECT_EQ(d->bodies[0], 1U);
  EXPECT_EQ(d->b.text(), "200");
}

}  // namespace
}  // namespace broadside::tests
