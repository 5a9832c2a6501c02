// Runs that end well, runs that are cut short, and what each leaves behind.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/rows.hpp"
#include "core/trace/trace_reader.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const ScratchFolder& folder, const std::string& sub) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / sub)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// A scene that would take minutes: 3000 frames of 300 procedural bodies.
std::string long_scene() {
  return "freefall:sphere:300";
}

TEST(Run, EveryKindOfEngineLeavesItsTrace) {
  const ScratchFolder folder;
  const Ended ended = run_program({"run", "freefall:sphere:12", "--frames", "120", "--engine", "octree-cpu", "--engine",
                                   "all-pairs", "--engine", "bullet-dbvt", "--engine", "fcl-tree", "--engine",
                                   "fcl-mesh", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(names_in(folder, "out"), (std::vector<std::string>{"all-pairs.h5", "bullet-dbvt.h5", "cells.json",
                                                               "fcl-mesh.h5", "fcl-tree.h5", "octree-cpu.h5"}));
  for (const char* subject : {"bullet-dbvt.h5", "fcl-tree.h5", "octree-cpu.h5"}) {
    const Ended checked = run_program(
        {"check", (folder / "out" / subject).string(), "--against", (folder / "out" / "all-pairs.h5").string()});
    EXPECT_EQ(checked.exit_code, 0) << subject << "\n" << checked.out << checked.err;
  }
  const Ended proximity = run_program(
      {"check", (folder / "out" / "octree-cpu.h5").string(), "--against", (folder / "out" / "fcl-mesh.h5").string()});
  EXPECT_EQ(proximity.exit_code, 0) << proximity.out << proximity.err;
}

TEST(Run, EnginesThatDoNotSimulateBringTheirDriver) {
  const ScratchFolder folder;
  const Ended ended = run_program(
      {"run", "freefall:sphere:4", "--frames", "5", "--engine", "all-pairs", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(names_in(folder, "out"), (std::vector<std::string>{"all-pairs.h5", "cells.json", "octree-cpu.h5"}));
}

TEST(Run, ThreadsDoNotChangeADigest) {
  const ScratchFolder folder;
  const Ended ended = run_program({"run", "freefall:sphere:30", "--frames", "150", "--engine", "octree-cpu[threads=1]",
                                   "--engine", "octree-cpu[threads=2]", "--out", folder.text()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const Ended checked = run_program({"check", (folder / "octree-cpu+threads=1.h5").string(), "--against",
                                     (folder / "octree-cpu+threads=2.h5").string(), "--validator", "determinism"});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  EXPECT_NE(checked.out.find("pass"), std::string::npos) << checked.out;
}

TEST(Run, CtrlCLeavesAReadableTraceAndNoFinalName) {
  const ScratchFolder folder;
  const pid_t child =
      start_program(folder, {"run", long_scene(), "--engine", "octree-cpu", "--out", (folder / "out").string()});
  const fs::path part = folder / "out" / "octree-cpu.h5.part";
  for (int k = 0; k < 600 && !(fs::exists(part) && fs::file_size(part) > 20000); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(child, SIGINT);
  const Ended ended = wait_for(folder, child);
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "out" / "octree-cpu.h5"));
  auto rows = core::read_rows(folder / "out");
  ASSERT_TRUE(rows.ok());
  ASSERT_EQ(rows.value().cells.size(), 1U);
  EXPECT_EQ(rows.value().cells[0].state, core::CellState::kInterrupted);

  auto trace = core::TraceReader::open(part);
  ASSERT_TRUE(trace.ok()) << trace.error().line();
  EXPECT_EQ(trace.value().frame_count(), rows.value().cells[0].frames) << "frames were lost";
  EXPECT_GT(trace.value().frame_count(), 0U);

  const Ended recovered = run_program({"recover", part.string()});
  EXPECT_EQ(recovered.exit_code, 0) << recovered.err;
  EXPECT_TRUE(fs::exists(folder / "out" / "octree-cpu.h5"));
}

TEST(Run, EngineWithoutItsDeviceIsSaidToBeAbsent) {
  const ScratchFolder folder;
  const Ended ended =
      run_program({"run", "freefall:sphere:4", "--frames", "3", "--engine", "octree-gpu", "--out", folder.text()});
  if (ended.exit_code == 0) GTEST_SKIP() << "this machine has a GPU that octree-gpu ran on";
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  EXPECT_NE(ended.out.find("not measured"), std::string::npos) << ended.out;
}

// A file system of one megabyte: the trace does not fit.
TEST(Run, FullDiskIsOneClearLineAndNoFinalName) {
  const ScratchFolder folder;
  const fs::path small = folder / "small";
  fs::create_directory(small);
  if (mount("tmpfs", small.c_str(), "tmpfs", 0, "size=1m") != 0)
    GTEST_SKIP() << "cannot mount a small tmpfs here: " << std::strerror(errno);
  const Ended ended = run_program({"run", "randommove:sphere:100", "--frames", "2000", "--engine", "octree-cpu",
                                   "--out", (small / "out").string()});
  const bool has_final_name = fs::exists(small / "out" / "octree-cpu.h5");
  umount(small.c_str());
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_NE(ended.exit_code, -1) << "ended by a signal";
  EXPECT_NE(ended.err.find("space"), std::string::npos) << ended.err;
  EXPECT_FALSE(has_final_name);
}

TEST(Run, FileSizeLimitIsOneClearLineToo) {
  const ScratchFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1U << 20U, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // the child inherits it
  const pid_t child = start_program(folder, {"run", "randommove:sphere:100", "--frames", "2000", "--engine",
                                             "octree-cpu", "--out", (folder / "out").string()});
  setrlimit(RLIMIT_FSIZE, &before);
  const Ended ended = wait_for(folder, child);
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "out" / "octree-cpu.h5"));
}

TEST(Run, EmptySceneAndOneBody) {
  for (const char* scene : {"freefall:sphere:0", "freefall:sphere:1"}) {
    const ScratchFolder folder;
    const Ended ended =
        run_program({"run", scene, "--frames", "4", "--engine", "octree-cpu", "--engine", "all-pairs", "--engine",
                     "bullet-dbvt", "--engine", "fcl-tree", "--engine", "fcl-mesh", "--out", folder.text()});
    EXPECT_EQ(ended.exit_code, 0) << scene << ended.out << ended.err;
    const Ended checked = run_program({"check", (folder / "octree-cpu.h5").string()});
    EXPECT_EQ(checked.exit_code, 0) << scene << checked.out;
  }
}

TEST(Run, AllBodiesAtOnePointIsAScene) {
  const ScratchFolder folder;
  std::ofstream scene(folder / "point.toml");
  scene
      << "name = \"point\"\nframes = 10\n[domain]\nmin_m = [-5, -5, -5]\nmax_m = [5, 5, 5]\n[[mesh]]\nname = \"cube\"\n"
         "shape = \"box\"\nsides_m = [1, 1, 1]\nsegments = [4, 4, 4]\n";
  for (int k = 0; k < 5; ++k) scene << "[[body]]\nposition_m = [0, 0, 0]\n";
  scene.close();
  const Ended ended =
      run_program({"run", (folder / "point.toml").string(), "--engine", "octree-cpu", "--engine", "all-pairs",
                   "--engine", "bullet-dbvt", "--engine", "fcl-tree", "--engine", "fcl-mesh", "--out", folder.text()});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  const Ended checked =
      run_program({"check", (folder / "octree-cpu.h5").string(), "--against", (folder / "all-pairs.h5").string()});
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
}

TEST(Pairs, EnginesAgreeOnBoxesAndADifferenceIsAFailure) {
  const Ended agreed = run_program({"pairs", "boxes:heaps:3000", "--engine", "octree-cpu", "--engine", "all-pairs",
                                    "--engine", "bullet-dbvt", "--engine", "fcl-tree"});
  EXPECT_EQ(agreed.exit_code, 0) << agreed.out << agreed.err;
  // The printed P-Alg 2 loses pairs across cells, and the verdict says so.
  const Ended lost = run_program({"pairs", "boxes:uniform:3000", "--engine", "all-pairs", "--engine",
                                  "octree-cpu[variant=printed-E2]", "--digest"});
  EXPECT_EQ(lost.exit_code, 1) << lost.out << lost.err;
}

TEST(Compare, ARunAgainstItselfIsGoodAndAVanishedCellIsNot) {
  const ScratchFolder folder;
  const std::string base = (folder / "base").string();
  const std::string head = (folder / "head").string();
  const std::vector<std::string> run{"run", "freefall:sphere:4", "--frames", "5", "--engine", "octree-cpu", "--out"};
  std::vector<std::string> both = run;
  both.insert(both.end(), {base, "--engine", "all-pairs"});
  std::vector<std::string> one = run;
  one.push_back(head);
  ASSERT_EQ(run_program(both).exit_code, 0);
  ASSERT_EQ(run_program(one).exit_code, 0);
  EXPECT_EQ(run_program({"compare", base, base}).exit_code, 0);
  const Ended vanished = run_program({"compare", base, head});
  EXPECT_EQ(vanished.exit_code, 3) << vanished.out;
  EXPECT_NE(vanished.out.find("all-pairs"), std::string::npos) << vanished.out;
}

TEST(Run, AnEngineThatHasNotTheShapeIsUnsupportedAndDidNotCrash) {
  const ScratchFolder folder;
  // With a limit, one of our own engines also runs in a child process, as vendors' engines do. plain-rigid has no
  // cylinders.
  const Ended ended = run_program({"run", "rigid:disk:euler", "--engine", "plain-rigid", "--frames", "5",
                                   "--time-limit", "60", "--out", folder.text()});
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("unsupported"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("cylinder"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("crashed"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace broadside::tests
