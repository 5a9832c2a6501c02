// The writer's thread: its queue is bounded, waits instead of dropping, and passes errors on.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdlib>
#include <iostream>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_stream.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kStreamedBodies = 3000;

std::vector<FrameRecord> frames_of(std::uint64_t count) {
  Bits bits(9);
  std::vector<FrameRecord> frames;
  for (std::uint64_t k = 0; k < count; ++k) frames.push_back(random_frame(bits, k, kStreamedBodies, kAllGroups));
  return frames;
}

void expect_streamed_frames(const std::filesystem::path& path, const std::vector<FrameRecord>& wrote) {
  auto reader = TraceReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().line();
  ASSERT_EQ(reader.value().frame_count(), wrote.size());
  for (std::uint64_t k = 0; k < wrote.size(); ++k) {
    auto frame = reader.value().read(k, kAllGroups);
    ASSERT_TRUE(frame.ok()) << frame.error().line();
    ASSERT_EQ(first_difference(wrote[k], frame.value()), "") << "frame " << k;
  }
}

// Noise does not compress, so the thread is far slower than this loop: it must wait, and nothing may be missing.
TEST(Stream, AFullQueueMakesTheRunWaitAndLosesNothing) {
  const Folder folder;
  const std::vector<FrameRecord> frames = frames_of(60);
  auto stream =
      TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(kStreamedBodies), kAllGroups), 1U << 20U);
  ASSERT_TRUE(stream.ok()) << stream.error().line();
  for (const FrameRecord& f : frames) ASSERT_TRUE(stream.value().append(f).ok());
  EXPECT_GT(stream.value().waits(), 0U);
  ASSERT_TRUE(stream.value().finish().ok());
  expect_streamed_frames(folder / "t.h5", frames);
}

TEST(Stream, AFrameLargerThanTheQueueGoesThrough) {
  const Folder folder;
  const std::vector<FrameRecord> frames = frames_of(3);
  auto stream = TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(kStreamedBodies), kAllGroups), 0);
  ASSERT_TRUE(stream.ok());
  for (const FrameRecord& f : frames) ASSERT_TRUE(stream.value().append(f).ok());
  ASSERT_TRUE(stream.value().finish().ok());
  expect_streamed_frames(folder / "t.h5", frames);
}

TEST(Stream, FlushWaitsUntilAReaderSeesEveryFrame) {
  const Folder folder;
  const std::vector<FrameRecord> frames = frames_of(7);
  auto stream = TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(kStreamedBodies), kAllGroups));
  ASSERT_TRUE(stream.ok());
  for (const FrameRecord& f : frames) ASSERT_TRUE(stream.value().append(f).ok());
  ASSERT_TRUE(stream.value().flush().ok());
  expect_streamed_frames(folder / "t.h5.part", frames);
}

TEST(Stream, OneThatGoesOutOfScopeKeepsWhatWasQueued) {
  const Folder folder;
  const std::vector<FrameRecord> frames = frames_of(9);
  {
    auto stream = TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(kStreamedBodies), kAllGroups));
    ASSERT_TRUE(stream.ok());
    for (const FrameRecord& f : frames) ASSERT_TRUE(stream.value().append(f).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "t.h5"));
  expect_streamed_frames(folder / "t.h5.part", frames);
}

// The disk refuses a write on the other thread; append or finish returns that same error line.
TEST(Stream, AnErrorOfTheThreadReachesTheRun) {
  const Folder folder;
  const auto write_with_limit = [&folder] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{3U << 20U, 3U << 20U};
    setrlimit(RLIMIT_FSIZE, &limit);
    auto stream =
        TraceStream::create(folder / "t.h5", header_of(tetrahedra_scene(kStreamedBodies), kAllGroups), 1U << 20U);
    if (!stream) exit(2);
    std::string line;
    for (const FrameRecord& f : frames_of(60))
      if (const Status s = stream.value().append(f); !s && line.empty()) line = s.error().line();
    const Status end = stream.value().finish();
    if (end.ok() || (!line.empty() && line != end.error().line())) exit(3);
    std::cerr << end.error().line() << '\n';
    exit(0);
  };
  EXPECT_EXIT(write_with_limit(), testing::ExitedWithCode(0), "^[^\n]*t.h5.part: [^\n]*larger than this process may");
  EXPECT_FALSE(std::filesystem::exists(folder / "t.h5"));
}

}  // namespace
}  // namespace broadside::tests
