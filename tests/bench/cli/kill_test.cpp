// Runs that are killed at any moment leave a whole file that can be recovered and continued, digest by digest.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <random>
#include <thread>

#include "core/trace/trace_reader.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;
using Digests = std::map<std::uint64_t, std::uint64_t>;  // by step

constexpr const char* kName = "octree-cpu.h5";
constexpr std::size_t kBodies = 100;
constexpr std::uint64_t kFrames = 3000;
// The full run takes longer than any wait here, so a killed run is always cut short.
constexpr std::uint64_t kEndless = 4000000;

// Bodies move in every frame, so no two frames have one digest.
std::vector<std::string> run_of(std::uint64_t frames, const fs::path& out) {
  return {"run",       "randommove:sphere:100", "--frames", std::to_string(frames), "--engine", "octree-cpu", "--out",
          out.string()};
}

Digests digests_of(const fs::path& trace) {
  Digests digests;
  auto reader = core::TraceReader::open(trace);
  EXPECT_TRUE(reader.ok()) << reader.error().line();
  if (!reader) return digests;
  for (std::uint64_t k = 0; k < reader.value().frame_count(); ++k) {
    digests[reader.value().steps()[k]] = reader.value().digests()[k];
    // Every frame is there, not only its digest.
    const auto frame = reader.value().read(k, reader.value().header().groups);
    EXPECT_TRUE(frame.ok()) << frame.error().line();
    EXPECT_EQ(frame.ok() ? frame.value().position.size() : 0U, kBodies);
  }
  return digests;
}

const Digests& unbroken(std::uint64_t frames) {
  static std::map<std::uint64_t, Digests> known;
  if (known.contains(frames)) return known[frames];
  const ScratchFolder folder;
  EXPECT_EQ(run_program(run_of(frames, folder / "out")).exit_code, 0);
  known[frames] = digests_of(folder / "out" / kName);
  EXPECT_EQ(known[frames].size(), frames);
  return known[frames];
}

// Both begin with the same frames, bit by bit, for as long as the shorter one lasts: the length of a run changes none
// of its frames.
void expect_same_beginning(const Digests& whole, const Digests& found) {
  auto at = whole.begin();
  for (const auto& [step, digest] : found) {
    if (at == whole.end()) return;
    ASSERT_EQ(at->first, step);
    ASSERT_EQ(at->second, digest) << "step " << step;
    ++at;
  }
}

struct Tally {
  int recovered = 0;
  int before_first_frame = 0;
  std::uint64_t frames = 0;
};

// Starts a run, kills it after this time, recovers what it left and compares.
void kill_and_recover(std::chrono::milliseconds after, Tally& tally) {
  const ScratchFolder folder;
  const pid_t child = start_program(folder, run_of(kEndless, folder / "out"));
  std::this_thread::sleep_for(after);
  kill(child, SIGKILL);
  wait_for(folder, child);
  const fs::path whole = folder / "out" / kName;
  const fs::path part = whole.string() + ".part";
  ASSERT_FALSE(fs::exists(whole)) << "a final name with partial content";
  if (!fs::exists(part)) {
    ++tally.before_first_frame;
    return;
  }
  const Ended recovered = run_program({"recover", part.string()});
  if (recovered.exit_code != 0) {
    EXPECT_EQ(recovered.exit_code, 2);
    EXPECT_TRUE(is_one_line(recovered.err)) << recovered.err;
    EXPECT_TRUE(recovered.err.find("not one whole frame") != std::string::npos ||
                recovered.err.find("before its first frame") != std::string::npos ||
                recovered.err.find("not an HDF5 file") != std::string::npos)
        << recovered.err;
    EXPECT_FALSE(fs::exists(whole));
    ++tally.before_first_frame;
    return;
  }
  const Digests found = digests_of(whole);
  EXPECT_NE(recovered.out.find(std::to_string(found.size()) + " of " + std::to_string(kEndless) + " frames recovered"),
            std::string::npos)
      << recovered.out;
  expect_same_beginning(unbroken(kFrames), found);
  ++tally.recovered;
  tally.frames += found.size();
}

void kill_often(int tries, std::uint32_t seed, unsigned longest_ms) {
  std::mt19937 random(seed);
  Tally tally;
  for (int k = 0; k < tries && !testing::Test::HasFailure(); ++k)
    kill_and_recover(std::chrono::milliseconds(random() % longest_ms), tally);
  std::printf("%d runs killed: %d recovered with %llu frames in all, %d had not one whole frame\n", tries,
              tally.recovered, static_cast<unsigned long long>(tally.frames), tally.before_first_frame);
}

TEST(Kill, RunsAreRecoveredFrameByFrame) {
  kill_often(5, 4, 700);
}

TEST(Kill, SlowTwoHundredRuns) {
  kill_often(200, 5, 2000);
}

// The run is killed once a reader sees frames in its file, so that there is something to continue. A run that ends
// before it is killed (this process may have to wait) is started again.
fs::path kill_when_it_has_frames(const ScratchFolder& folder, const std::vector<std::string>& run) {
  const fs::path whole = folder / "out" / kName;
  const fs::path part = whole.string() + ".part";
  for (int tries = 0; tries < 10; ++tries) {
    const pid_t child = start_program(folder, run);
    for (int k = 0; k < 4000 && !fs::exists(whole); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (!fs::exists(part)) continue;
      const auto reader = core::TraceReader::open(part);
      if (reader.ok() && reader.value().frame_count() > 10) break;
    }
    kill(child, SIGKILL);
    wait_for(folder, child);
    if (!fs::exists(whole)) break;
    fs::remove(whole);
  }
  return part;
}

void resume_after_kills(std::uint64_t frames, int kills) {
  const ScratchFolder folder;
  std::vector<std::string> run = run_of(frames, folder / "out");
  run.emplace_back("--resume");
  for (int k = 0; k < kills; ++k) kill_when_it_has_frames(folder, run);
  const Ended resumed = run_program(run);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("goes on after step"), std::string::npos) << resumed.err;
  EXPECT_EQ(digests_of(folder / "out" / kName), unbroken(frames));
  EXPECT_FALSE(fs::exists(folder / "out" / (std::string(kName) + ".part")));
  EXPECT_FALSE(fs::exists(folder / "out" / (std::string(kName) + ".interrupted")));
  const Ended checked = run_program({"check", (folder / "out" / kName).string()});
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  const Ended again = run_program(run);
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST(Resume, AfterAKillTheDigestsAreThoseOfAnUnbrokenRun) {
  resume_after_kills(kFrames, 1);
}

TEST(Resume, SlowThreeKillsAreNoDifferent) {
  resume_after_kills(30000, 3);
}

// A recovered trace under its final name can be continued too.
TEST(Resume, FromARecoveredTraceAndOnlyByItsOwnStamp) {
  const ScratchFolder folder;
  const std::vector<std::string> run = run_of(kFrames, folder / "out");
  const fs::path part = kill_when_it_has_frames(folder, run);
  ASSERT_EQ(run_program({"recover", part.string()}).exit_code, 0);
  fs::remove(part);
  const auto resumed_with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = run;
    all.emplace_back("--resume");
    all.insert(all.end(), more.begin(), more.end());
    return run_program(all);
  };
  const auto expect_refused = [](const Ended& ended, const char* word) {
    EXPECT_EQ(ended.exit_code, 2) << ended.out;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(word), std::string::npos) << ended.err;
  };
  expect_refused(resumed_with({"--every", "2"}), "recorded other steps");
  expect_refused(resumed_with({"--window", "5:9"}), "recorded other steps");
  expect_refused(resumed_with({"--record", "digest"}), "--resume");
  expect_refused(run_program({"run", "randommove:sphere:100", "--frames", "2999", "--engine", "octree-cpu", "--out",
                              (folder / "out").string(), "--resume"}),
                 "another scene");
  const Ended good = resumed_with({});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(digests_of(folder / "out" / kName), unbroken(kFrames));
}

TEST(Resume, ATraceOfDigestsCannotBeGoneOnFrom) {
  const ScratchFolder folder;
  std::vector<std::string> run = run_of(50, folder / "out");
  run.insert(run.end(), {"--record", "digest"});
  ASSERT_EQ(run_program(run).exit_code, 0);
  std::vector<std::string> resume = run_of(50, folder / "out");
  resume.emplace_back("--resume");
  const Ended ended = run_program(resume);
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("without the bodies' states"), std::string::npos) << ended.err;
}

TEST(Resume, WithNothingThereItStartsAtTheBeginning) {
  const ScratchFolder folder;
  std::vector<std::string> run = run_of(30, folder / "out");
  run.emplace_back("--resume");
  const Ended ended = run_program(run);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("no trace to resume from"), std::string::npos) << ended.err;
  EXPECT_EQ(digests_of(folder / "out" / kName).size(), 30U);
}

TEST(Window, OnlyItsStepsAreRecordedAndTheLast) {
  const ScratchFolder folder;
  std::vector<std::string> run = run_of(100, folder / "out");
  run.insert(run.end(), {"--window", "10:12", "--window", "40:44", "--every", "2"});
  ASSERT_EQ(run_program(run).exit_code, 0);
  const Digests& all = unbroken(100);
  EXPECT_EQ(digests_of(folder / "out" / kName), (Digests{{10, all.at(10)},
                                                         {12, all.at(12)},
                                                         {40, all.at(40)},
                                                         {42, all.at(42)},
                                                         {44, all.at(44)},
                                                         {100, all.at(100)}}));
  for (const char* bad : {"5", "9:5", "0:3", "a:b", "1:2x", ""}) {
    std::vector<std::string> wrong = run_of(100, folder / "bad");
    wrong.insert(wrong.end(), {"--window", bad});
    const Ended ended = run_program(wrong);
    EXPECT_EQ(ended.exit_code, 2) << bad;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
}

// One clear line and exit code 2 for every fault of the place.
TEST(Place, TwoRunsIntoOneNameAreOneClearLine) {
  const ScratchFolder folder;
  const ScratchFolder second;
  const pid_t child = start_program(folder, run_of(kEndless, folder / "out"));
  const fs::path part = folder / "out" / (std::string(kName) + ".part");
  for (int k = 0; k < 2000 && !fs::exists(part); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Ended refused = run_program(run_of(10, folder / "out"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
  EXPECT_NE(refused.err.find("another writer"), std::string::npos) << refused.err;
  kill(child, SIGKILL);
  wait_for(folder, child);
}

// Root may write anywhere but where the file system itself is read-only.
TEST(Place, AReadOnlyFolderIsOneClearLine) {
  const ScratchFolder folder;
  const fs::path place = folder / "read_only";
  fs::create_directory(place);
  if (mount("tmpfs", place.c_str(), "tmpfs", MS_RDONLY, "size=1m") != 0)
    GTEST_SKIP() << "cannot mount a read-only tmpfs here: " << std::strerror(errno);
  for (const fs::path& out : {place, place / "new"}) {
    const Ended ended = run_program(run_of(10, out));
    EXPECT_EQ(ended.exit_code, 2) << out;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find("Read-only file system"), std::string::npos) << ended.err;
  }
  umount(place.c_str());
}

// The folder is removed while the run writes into it: the file goes on without a name, and cannot get its final one.
TEST(Place, AFolderThatIsRemovedMeanwhileIsOneClearLine) {
  const ScratchFolder folder;
  const pid_t child = start_program(folder, run_of(6000, folder / "out"));
  const fs::path part = folder / "out" / (std::string(kName) + ".part");
  for (int k = 0; k < 2000 && !fs::exists(part); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  fs::remove_all(folder / "out");
  const Ended ended = wait_for(folder, child);
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("folder does not exist"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace broadside::tests
