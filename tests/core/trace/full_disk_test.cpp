// A full disk gives one clear error, no file under the final name, and a process that ends normally.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr int kNoMount = 77;
constexpr std::uint32_t kLargeFrameBodies = 50;

// Writes random frames until the disk is full. Returns the error line, "" when there never was one.
std::string write_too_much(const std::filesystem::path& path, bool flushes) {
  auto writer = TraceWriter::create(path, header_of(tetrahedra_scene(kLargeFrameBodies), kAllGroups));
  if (!writer) return writer.error().line();
  Bits bits(5);
  for (std::uint64_t k = 0; k < 4000; ++k) {
    Status s = writer.value().append(random_frame(bits, k, kLargeFrameBodies, kAllGroups));
    if (s.ok() && flushes && k % 50 == 0) s = writer.value().flush();
    if (s.ok()) continue;
    // After a failure every call fails with the same words.
    const Status again = writer.value().append(random_frame(bits, k + 1, kLargeFrameBodies, kAllGroups));
    const Status end = writer.value().finish();
    return again.ok() || end.ok() || end.error().line() != s.error().line() ? "it forgot its failure"
                                                                            : s.error().line();
  }
  const Status end = writer.value().finish();
  return end ? "" : end.error().line();
}

// Runs in a child process and ends it so that exit handlers run, HDF5's among them. Prints what was seen.
[[noreturn]] void report(const std::string& line, const std::filesystem::path& path) {
  std::cerr << line << '\n';
  if (std::filesystem::exists(path)) std::cerr << "the final name exists\n";
  const auto part = TraceReader::open(path.string() + ".part");
  if (part) {
    Bits bits(5);
    for (std::uint64_t k = 0; k < part.value().frame_count(); ++k) {
      const auto frame = part.value().read(k, kAllGroups);
      const FrameRecord wrote = random_frame(bits, k, kLargeFrameBodies, kAllGroups);
      if (!frame)
        std::cerr << "unreadable: " << frame.error().line() << '\n';
      else if (!first_difference(wrote, frame.value()).empty())
        std::cerr << "different: frame " << k << '\n';
    }
    std::cerr << "left " << (part.value().frame_count() > 0 ? "some" : "no") << " frames\n";
  }
  std::exit(0);
}

[[noreturn]] void write_with_limit(const std::filesystem::path& path, std::uint64_t bytes, bool flushes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  report(write_too_much(path, flushes), path);
}

// A file system of that size, visible only to this process.
bool mount_small(const std::filesystem::path& folder, const char* size) {
  return unshare(CLONE_NEWNS) == 0 && mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
}

bool can_mount() {
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) _exit(mount_small(folder.path(), "size=1m") ? 0 : kNoMount);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

class FullDisk : public testing::TestWithParam<bool> {
 protected:
  const Folder folder_;
};

// The one line contains no hint at a difference, and the frames before the error are still there.
constexpr const char* kLimitLine =
    "^[^\n]*t.h5.part: writing frame [^\n]*larger than this process may write[^\n]*broadside recover t.h5.part\nleft "
    "some frames\n$";
constexpr const char* kFullLine =
    "^[^\n]*t.h5.part: writing frame [^\n]*the disk is full[^\n]*free space[^\n]*broadside recover t.h5.part\nleft "
    "some frames\n$";

TEST_P(FullDisk, AFileSizeLimitIsReportedAndTheProcessEndsWell) {
  EXPECT_EXIT(write_with_limit(folder_ / "t.h5", 3U << 20U, GetParam()), testing::ExitedWithCode(0), "t.h5.part");
}

INSTANTIATE_TEST_SUITE_P(Flushed, FullDisk, testing::Bool());

TEST_F(FullDisk, WhatWasFlushedBeforeIsStillThere) {
  EXPECT_EXIT(write_with_limit(folder_ / "t.h5", 3U << 20U, true), testing::ExitedWithCode(0), kLimitLine);
}

TEST_F(FullDisk, ALimitThatEvenTheSceneExceedsLeavesNothing) {
  EXPECT_EXIT(write_with_limit(folder_ / "t.h5", 4096, true), testing::ExitedWithCode(0),
              "^[^\n]*t.h5.part: creating the trace[^\n]*larger than[^\n]*\n$");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(FullDisk, AFullFileSystemIsReportedAndTheProcessEndsWell) {
  if (!can_mount()) GTEST_SKIP() << "this process may not mount a small tmpfs";
  const auto fill = [this](const char* size) {
    if (!mount_small(folder_.path(), size)) std::exit(kNoMount);
    report(write_too_much(folder_ / "t.h5", true), folder_ / "t.h5");
  };
  EXPECT_EXIT(fill("size=3m"), testing::ExitedWithCode(0), kFullLine);
}

// Room for the part file but not for the copy that would drop its waste: the part file becomes the trace.
TEST_F(FullDisk, ATraceIsFinishedWithoutRoomForACompactCopy) {
  if (!can_mount()) GTEST_SKIP() << "this process may not mount a small tmpfs";
  const auto fill = [this] {
    if (!mount_small(folder_.path(), "size=8m")) std::exit(kNoMount);
    const std::filesystem::path path = folder_ / "t.h5";
    auto writer = TraceWriter::create(path, header_of(tetrahedra_scene(kLargeFrameBodies), kAllGroups));
    if (!writer) std::exit(2);
    Bits bits(5);
    std::uint64_t frames = 0;
    // The part file fills the file system but for 1 MiB; the trace without waste is larger than that.
    for (struct statvfs disk = {};
         statvfs(folder_.path().c_str(), &disk) == 0 && disk.f_bavail * disk.f_bsize > (1U << 20U); ++frames)
      if (!writer.value().append(random_frame(bits, frames, kLargeFrameBodies, kAllGroups)) || !writer.value().flush())
        std::exit(3);
    const Status end = writer.value().finish();
    if (!end) std::cerr << end.error().line() << '\n', std::exit(4);
    const auto reader = TraceReader::open(path);
    if (!reader || reader.value().frame_count() != frames) std::exit(5);
    std::exit(std::distance(std::filesystem::directory_iterator(folder_.path()), {}) == 1 ? 0 : 6);
  };
  EXPECT_EXIT(fill(), testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace broadside::tests
