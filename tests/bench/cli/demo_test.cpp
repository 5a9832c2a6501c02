// The main job: which files it leaves, which it takes over from an earlier run, and what its exit code depends on.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/cli/main_job.hpp"
#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> small_demo(const ScratchFolder& folder, const std::string& turning_scene) {
  return {"demo", "--scene", "freefall:sphere:6", "--turning-scene", turning_scene, "--frames", "60", "--repetitions",
          "1",    "--out",   folder.text()};
}

core::RunRows one_row(core::Outcome outcome, core::CellState state) {
  core::RunRows rows;
  core::Cell cell;
  cell.state = state;
  rows.cells.push_back(cell);
  core::CellVerdicts judged;
  core::Verdict verdict;
  verdict.outcome = outcome;
  judged.verdicts.push_back(verdict);
  rows.verdicts.push_back(judged);
  return rows;
}

TEST(MainJob, SecondCallTakesOverWhatIsThere) {
  const ScratchFolder folder;
  const std::vector<std::string> demo = small_demo(folder, "freefall:brick:2[rigid=1]");
  const Ended first = run_program(demo);
  ASSERT_TRUE(first.exit_code == 0) << first.out << first.err;
  for (const char* name : {"report.html", "report.md", "junit.xml", "octree-cpu.h5", "fcl-mesh.h5", "cells.json",
                           "turning/plain-rigid.h5", "turning/bullet-world.h5", "turning/cells.json"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  const char* kKept[] = {"octree-cpu.h5",          "verdicts.json",         "samples.json",
                         "turning/plain-rigid.h5", "turning/verdicts.json", "turning/samples.json"};
  std::vector<fs::file_time_type> written;
  for (const char* name : kKept) written.push_back(fs::last_write_time(folder / name));
  const Ended second = run_program(demo);
  EXPECT_EQ(second.exit_code, first.exit_code);
  for (std::size_t k = 0; k < std::size(kKept); ++k)
    EXPECT_EQ(fs::last_write_time(folder / kKept[k]), written[k]) << kKept[k];
}

// Verdicts belong to the content of a trace, not to its name: verdicts are kept together with a digest of each file.
TEST(MainJob, AChangedTraceAndDamagedVerdictsAreJudgedAgain) {
  const ScratchFolder folder;
  const std::vector<std::string> demo = small_demo(folder, "freefall:brick:2[rigid=1]");
  const Ended first = run_program(demo);
  ASSERT_EQ(first.exit_code, 0) << first.out << first.err;
  const std::string verdicts = read_text(folder / "verdicts.json");
  const fs::path changed = folder / "verdicts.json";
  const fs::path others = folder / "turning/verdicts.json";
  const auto of_others = fs::last_write_time(others);

  // A byte behind the last one that HDF5 uses: the trace reads as before, and is another file.
  std::ofstream(folder / "octree-cpu.h5", std::ios::binary | std::ios::app) << 'x';
  auto before = fs::last_write_time(changed);
  const Ended second = run_program(demo);
  EXPECT_EQ(second.exit_code, 0) << second.out << second.err;
  EXPECT_NE(fs::last_write_time(changed), before);
  EXPECT_EQ(read_text(changed), verdicts);
  EXPECT_EQ(fs::last_write_time(others), of_others);

  fs::resize_file(changed, 100);
  const Ended third = run_program(demo);
  EXPECT_EQ(third.exit_code, 0) << third.out << third.err;
  EXPECT_EQ(read_text(changed), verdicts);
}

TEST(MainJob, TheTurningSceneIsOnThePageAndItsTimesAreAdmittedWhereTheMotionIsProven) {
  const ScratchFolder folder;
  const Ended ended = run_program(small_demo(folder, "freefall:brick:12[rigid=1]"));
  ASSERT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  const std::string page = read_text(folder / "report.html");
  EXPECT_NE(page.find("turning/plain-rigid.h5"), std::string::npos);
  EXPECT_NE(page.find("\"turns\":\""), std::string::npos) << "the 3-D view has orientations";
  EXPECT_NE(page.find("do not decide the exit code"), std::string::npos);
  // Bullet leaves friction where it has no normal impulse, which reference/README.md lists: shown, and not decisive.
  const std::size_t others = ended.out.find("Engines made by others on freefall:brick:12");
  ASSERT_NE(others, std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("bullet-world: friction-cone FAIL", others), std::string::npos) << ended.out;
  const std::string junit = read_text(folder / "junit.xml");
  EXPECT_NE(junit.find("plain-rigid"), std::string::npos);
  EXPECT_EQ(junit.find("bullet-world"), std::string::npos) << "junit.xml holds what decides";
}

TEST(MainJob, OnlyDecidingRowsLeadToTheExitCode) {
  using core::CellState;
  using core::Outcome;
  const core::RunRows good = one_row(Outcome::kPass, CellState::kRecorded);
  const core::RunRows broken = one_row(Outcome::kFail, CellState::kRecorded);
  const core::RunRows crashed = one_row(Outcome::kPass, CellState::kCrashed);
  const core::RunRows absent = one_row(Outcome::kPass, CellState::kNotMeasured);
  EXPECT_EQ(bench::exit_of({{}, good, broken}), core::Exit::kGood);
  EXPECT_EQ(bench::exit_of({{}, good, crashed}), core::Exit::kGood);
  EXPECT_EQ(bench::exit_of({{}, absent, good}), core::Exit::kGood);
  EXPECT_EQ(bench::exit_of({{}, broken, good}), core::Exit::kFailed);
  EXPECT_EQ(bench::exit_of({{}, crashed, good}), core::Exit::kMissing);
}

TEST(MainJob, HelpSaysWhatTheExitCodeSpeaksOf) {
  const Ended ended = run_program({"demo", "--help"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.out.find("Engines made by others"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace broadside::tests
