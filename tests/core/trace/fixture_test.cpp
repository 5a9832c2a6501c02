// Files of every earlier format version are read as they were written. Each frame of a fixture has, as its digest, a
// sum over all that it holds, so the file itself says what a reader must find.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <vector>

#include "core/pair.hpp"
#include "core/trace/columns.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kFixtureBodies = 3;
constexpr std::uint64_t kFixtureFrames = 4;

// Over every row of every array, dataset by dataset in the order of their names; a dataset that a file lacks adds
// nothing.
std::uint64_t content_digest(const FrameRecord& frame) {
  // Datasets in float32 and in float64 have the same path.
  std::vector<const Column*> sorted;
  for (const Column& c : columns())
    if (c.layout == Layout::kRows || c.layout == Layout::kFrameBodies) sorted.push_back(&c);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Column* a, const Column* b) { return a->path < b->path; });
  std::uint64_t sum = 0;
  std::uint64_t place = 0;
  for (const Column* column : sorted) {
    const RecordSpan<const std::byte> records = records_of(frame, column->records);
    for (std::size_t i = 0; i < records.count; ++i) {
      // A hash of this test's own, because the file outlives changes of the frame digest.
      std::uint64_t hash = splitmix64(1 ^ splitmix64(++place));
      const std::byte* at = records.data + i * records.stride + column->offset;
      for (std::size_t b = 0; b < row_bytes(*column); ++b) hash = splitmix64(hash ^ static_cast<std::uint64_t>(at[b]));
      sum += hash;
    }
  }
  return sum;
}

std::filesystem::path fixture(std::uint32_t version) {
  return std::string(BROADSIDE_SOURCE_DIR "/tests/core/trace/fixtures/format-") + std::to_string(version) + ".h5";
}

TEST(Fixture, EveryVersionIsReadAsItWasWritten) {
  for (std::uint32_t version = 1; version <= kTraceFormatVersion; ++version) {
    auto reader = TraceReader::open(fixture(version));
    ASSERT_TRUE(reader.ok()) << reader.error().line();
    EXPECT_EQ(reader.value().header().stamp.broadside_build, "broadside 0.1.0");
    EXPECT_EQ(reader.value().header().scene.body_count(), kFixtureBodies);
    ASSERT_EQ(reader.value().frame_count(), kFixtureFrames);
    std::size_t contacts = 0;
    std::size_t separations = 0;
    for (std::uint64_t k = 0; k < kFixtureFrames; ++k) {
      auto frame = reader.value().read(k, reader.value().header().groups);
      ASSERT_TRUE(frame.ok()) << frame.error().line();
      EXPECT_EQ(content_digest(frame.value()), frame.value().digest) << "format " << version << ", frame " << k;
      contacts += frame.value().contacts.size();
      separations += frame.value().separations.size();
    }
    EXPECT_GT(contacts, 0U);
    EXPECT_GT(separations, 0U);
  }
}

TEST(Fixture, AFlippedBitIsSeen) {
  auto reader = TraceReader::open(fixture(1));
  ASSERT_TRUE(reader.ok());
  FrameRecord frame = reader.value().read(0, kAllGroups).value();
  frame.position[0].x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(frame.position[0].x) ^ 1U);
  EXPECT_NE(content_digest(frame), frame.digest);
}

TEST(Fixture, ALaterVersionIsRefusedWithAdvice) {
  const Folder folder;
  std::filesystem::copy_file(fixture(kTraceFormatVersion), folder / "t.h5");
  std::filesystem::permissions(folder / "t.h5", std::filesystem::perms::owner_write,
                               std::filesystem::perm_options::add);
  const std::uint32_t later = kTraceFormatVersion + 1;
  raw_set_attribute(folder / "t.h5", "/", "format_version", H5T_NATIVE_UINT32, &later);
  const auto reader = TraceReader::open(folder / "t.h5");
  ASSERT_FALSE(reader.ok());
  const std::string line = reader.error().line();
  EXPECT_NE(line.find("trace format " + std::to_string(later)), std::string::npos) << line;
  EXPECT_NE(line.find("use a newer Broadside"), std::string::npos) << line;
}

// When the format gets a new version, its fixture is written once, by this program with BROADSIDE_FIXTURE set to
// tests/core/trace/fixtures/format-2.h5 and the options
//   --gtest_also_run_disabled_tests --gtest_filter=Fixture.DISABLED_IsWritten
TEST(Fixture, DISABLED_IsWritten) {
  const char* path = std::getenv("BROADSIDE_FIXTURE");
  ASSERT_NE(path, nullptr);
  auto writer = TraceWriter::create(path, header_of(tetrahedra_scene(kFixtureBodies), kAllGroups));
  ASSERT_TRUE(writer.ok()) << writer.error().line();
  Bits bits(21);
  for (std::uint64_t k = 0; k < kFixtureFrames; ++k) {
    FrameRecord frame = random_frame(bits, k, kFixtureBodies, kAllGroups);
    frame.digest = content_digest(frame);
    ASSERT_TRUE(writer.value().append(frame).ok());
  }
  ASSERT_TRUE(writer.value().finish().ok());
}

}  // namespace
}  // namespace broadside::tests
