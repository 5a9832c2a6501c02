// METHOD 9's statistics, against sums that were worked out by hand.
#include "core/trace/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

Contact contact(float depth_m, std::uint32_t b = 1) {
  Contact c;
  c.b = b;
  c.depth_m = depth_m;
  return c;
}

// The scene's slop is 0.001. Steps 1 to 100 are one window, 101 to 200 the next.
TEST(Statistics, AreOnesOfEachHundredSteps) {
  const Folder folder;
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(2), bit(Group::kContacts)));
  ASSERT_TRUE(writer.ok());
  FrameRecord f;
  for (const std::uint64_t step : {0, 1, 50, 100, 101, 250}) {
    f.step = step;
    f.contacts.clear();
    if (step == 1) f.contacts = {contact(0.25F), contact(0.0009765625F), contact(8.0F, kFirstFace)};
    if (step == 100) f.contacts = {contact(0.5F), contact(0.25F)};
    if (step == 101) f.contacts = {contact(4.0F, kFirstFace + 5)};
    if (step == 250) f.contacts = {contact(-0.5F)};
    ASSERT_TRUE(writer.value().append(f).ok());
  }
  ASSERT_TRUE(writer.value().finish().ok());
  const auto reader = TraceReader::open(folder / "t.h5");
  ASSERT_TRUE(reader.ok());
  const auto rows = reader.value().statistics();
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  ASSERT_EQ(rows.value().size(), 3U);

  const PenetrationStatistics& first = rows.value()[0];
  EXPECT_EQ(first.first_step, 0U);
  EXPECT_EQ(first.last_step, 100U);
  EXPECT_EQ(first.frames, 4U);
  EXPECT_EQ(first.body_contacts, 4U);
  EXPECT_EQ(first.face_contacts, 1U);
  EXPECT_EQ(first.mean_depth_m, (0.25 + 0.0009765625 + 0.5 + 0.25) / 4);  // powers of two: exact in any order
  EXPECT_EQ(first.largest_depth_m, 0.5) << "faces do not count as depths of pairs";
  EXPECT_EQ(first.share_above_slop, 0.75);

  const PenetrationStatistics& second = rows.value()[1];
  EXPECT_EQ(second.first_step, 101U);
  EXPECT_EQ(second.last_step, 101U);
  EXPECT_EQ(second.body_contacts, 0U);
  EXPECT_EQ(second.face_contacts, 1U);
  EXPECT_TRUE(std::isnan(second.mean_depth_m) && std::isnan(second.largest_depth_m) &&
              std::isnan(second.share_above_slop));

  const PenetrationStatistics& third = rows.value()[2];
  EXPECT_EQ(third.first_step, 250U);
  EXPECT_EQ(third.largest_depth_m, -0.5);
  EXPECT_EQ(third.share_above_slop, 0.0);
}

TEST(Statistics, ThereAreNoneWithoutContacts) {
  const Folder folder;
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(2), bit(Group::kPairs)));
  ASSERT_TRUE(writer.value().append({}).ok());
  ASSERT_TRUE(writer.value().finish().ok());
  const auto rows = TraceReader::open(folder / "t.h5").value().statistics();
  ASSERT_TRUE(rows.ok());
  EXPECT_TRUE(rows.value().empty());
}

}  // namespace
}  // namespace broadside::tests
