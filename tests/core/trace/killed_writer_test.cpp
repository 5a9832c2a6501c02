// A writer that is killed at any moment loses nothing that was flushed, and what it leaves is read bit by bit.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "core/trace/recover.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::uint32_t kKilledBodies = 20;
constexpr std::uint64_t kKilledFrames = 2000;

// Reports through the pipe, one byte per flush, how many frames are safe: flush k comes after frame 10 k.
[[noreturn]] void write_until_killed(const std::filesystem::path& path, int flushed) {
  auto writer = TraceWriter::create(path, header_of(tetrahedra_scene(kKilledBodies), kAllGroups));
  if (!writer) _exit(1);
  Bits bits(11);
  for (std::uint64_t k = 0; k < kKilledFrames; ++k) {
    if (!writer.value().append(random_frame(bits, k, kKilledBodies, kAllGroups))) _exit(2);
    if ((k + 1) % 10 != 0) continue;
    if (!writer.value().flush()) _exit(3);
    if (::write(flushed, "x", 1) != 1) _exit(4);
  }
  for (;;) pause();
}

std::uint64_t bytes_in(int pipe_end) {
  std::uint64_t sum = 0;
  std::array<char, 4096> bytes{};
  for (ssize_t n = 1; (n = read(pipe_end, bytes.data(), bytes.size())) > 0;) sum += static_cast<std::uint64_t>(n);
  return sum;
}

void expect_frames(const TraceReader& reader) {
  Bits bits(11);
  for (std::uint64_t k = 0; k < reader.frame_count(); ++k) {
    const FrameRecord wrote = random_frame(bits, k, kKilledBodies, kAllGroups);
    const auto frame = reader.read(k, kAllGroups);
    ASSERT_TRUE(frame.ok()) << frame.error().line();
    ASSERT_EQ(first_difference(wrote, frame.value()), "") << "frame " << k;
  }
}

// Kills a writer after this time; returns the frames that a reader then finds.
std::uint64_t kill_and_read(const Folder& folder, std::chrono::microseconds after) {
  const std::filesystem::path path = folder / "t.h5";
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) write_until_killed(path, ends[1]);
  close(ends[1]);
  std::this_thread::sleep_for(after);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself: exit " << WEXITSTATUS(status);
  const std::uint64_t safe = 10 * bytes_in(ends[0]);
  close(ends[0]);
  EXPECT_FALSE(std::filesystem::exists(path));

  const auto reader = TraceReader::open(folder / "t.h5.part");
  if (!reader) {
    EXPECT_EQ(safe, 0U) << reader.error().line();
    return 0;
  }
  EXPECT_GE(reader.value().frame_count(), safe);
  expect_frames(reader.value());
  return reader.value().frame_count();
}

void kill_often(int tries, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uint64_t frames = 0;
  for (int k = 0; k < tries && !testing::Test::HasFailure(); ++k) {
    const Folder folder;
    frames += kill_and_read(folder, std::chrono::microseconds(random() % 300000));
  }
  // On a crowded machine perhaps no writer lived long enough to flush anything.
  for (int ms = 300; frames == 0 && ms < 20000 && !testing::Test::HasFailure(); ms *= 2) {
    const Folder folder;
    frames = kill_and_read(folder, std::chrono::milliseconds(ms));
  }
  EXPECT_GT(frames, 0U);
}

TEST(KilledWriter, LosesNothingThatWasFlushed) {
  kill_often(10, 1);
}

TEST(KilledWriter, SlowTwoHundredTries) {
  kill_often(200, 2);
}

TEST(KilledWriter, IsRecoveredToAFinishedTrace) {
  const Folder folder;
  std::uint64_t frames = 0;
  for (int ms = 300; frames == 0 && ms < 20000; ms *= 2) frames = kill_and_read(folder, std::chrono::milliseconds(ms));
  ASSERT_GT(frames, 0U);
  const auto report = recover_trace(folder / "t.h5.part", folder / "t.h5");
  ASSERT_TRUE(report.ok()) << report.error().line();
  EXPECT_EQ(report.value().frames_kept, frames);
  EXPECT_GE(report.value().frames_begun, frames);
  EXPECT_EQ(report.value().last_step, frames - 1);
  EXPECT_EQ(report.value().frames_planned, 150U) << "the scene has 300 frames, of which every 2nd was promised";
  const auto whole = TraceReader::open(folder / "t.h5");
  ASSERT_TRUE(whole.ok()) << whole.error().line();
  EXPECT_EQ(whole.value().frame_count(), frames);
  EXPECT_EQ(whole.value().frames_begun(), frames);
  EXPECT_EQ(whole.value().header().notes.at("recovered"), report.value().line());
  EXPECT_EQ(whole.value().header().notes.at("theta_m"), "0.0312");
  expect_frames(whole.value());
  EXPECT_TRUE(std::filesystem::exists(folder / "t.h5.part")) << "recovering must not destroy what it read";

  const auto again = recover_trace(folder / "t.h5.part", folder / "t.h5");
  ASSERT_FALSE(again.ok()) << "a trace was overwritten";
  EXPECT_NE(again.error().line().find("exists"), std::string::npos);
}

TEST(KilledWriter, ItsNameCanBeWrittenAgain) {
  const Folder folder;
  kill_and_read(folder, std::chrono::milliseconds(200));
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(1), 0));
  ASSERT_TRUE(writer.ok()) << writer.error().line();
  EXPECT_TRUE(writer.value().finish().ok());
  EXPECT_TRUE(TraceReader::open(folder / "t.h5").ok());
}

TEST(KilledWriter, ALiveOneIsReadUpToItsLastFlush) {
  const Folder folder;
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(kKilledBodies), kAllGroups));
  ASSERT_TRUE(writer.ok());
  Bits bits(11);
  for (std::uint64_t k = 0; k < 30; ++k)
    ASSERT_TRUE(writer.value().append(random_frame(bits, k, kKilledBodies, kAllGroups)).ok());
  ASSERT_TRUE(writer.value().flush().ok());
  const auto reader = TraceReader::open(folder / "t.h5.part");
  ASSERT_TRUE(reader.ok()) << reader.error().line();
  EXPECT_GE(reader.value().frame_count(), 30U);
  expect_frames(reader.value());
  const auto report = recover_trace(folder / "t.h5.part", folder / "other.h5");
  ASSERT_FALSE(report.ok()) << "recovered from under a writer";
  EXPECT_NE(report.error().line().find("still at work"), std::string::npos) << report.error().line();
  EXPECT_TRUE(writer.value().finish().ok());
}

TEST(KilledWriter, OneThatGoesOutOfScopeKeepsAllFramesInThePartFile) {
  const Folder folder;
  {
    auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(kKilledBodies), kAllGroups));
    ASSERT_TRUE(writer.ok());
    Bits bits(11);
    for (std::uint64_t k = 0; k < 25; ++k)
      ASSERT_TRUE(writer.value().append(random_frame(bits, k, kKilledBodies, kAllGroups)).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "t.h5"));
  const auto reader = TraceReader::open(folder / "t.h5.part");
  ASSERT_TRUE(reader.ok()) << reader.error().line();
  EXPECT_EQ(reader.value().frame_count(), 25U);
  expect_frames(reader.value());
}

}  // namespace
}  // namespace broadside::tests
