// Campaigns through the program: shares, interrupted cells, crashes, and the merged result against one process.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <tuple>

#include "bench/campaign/merge.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

const std::string kWrong = std::string(BROADSIDE_PLUGIN_DIR) + "/libwrong_engine.so";

std::string planned(const ScratchFolder& folder, const std::string& engines, const std::string& rest = "") {
  std::ofstream(folder / "c.toml") << "name = \"t\"\nscenes = [\"freefall:cube:{n}\"]\nengines = [" << engines
                                   << "]\nframes = 20\n"
                                   << rest << "[vary]\nn = [5, 30]\n";
  const Ended ended = run_program({"plan", (folder / "c.toml").string(), "--out", (folder / "d").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return (folder / "d").string();
}

using Digests = std::map<std::pair<std::string, std::string>, std::map<std::uint64_t, std::uint64_t>>;

Digests digests_in(const std::filesystem::path& folder) {
  Digests all;
  const auto rows = core::read_rows(folder);
  EXPECT_TRUE(rows.ok());
  for (const core::Cell& cell : rows.value().cells) all[{cell.stamp.scene_name, cell.stamp.label()}] = cell.digests;
  return all;
}

// Processes that have this text in their command line.
int processes_about(const std::string& text) {
  int count = 0;
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", gone))
    count += read_text(entry.path() / "cmdline").find(text) != std::string::npos ? 1 : 0;
  return count;
}

TEST(CampaignRun, SharesMergeToTheDigestsOfOneProcess) {
  const ScratchFolder folder;
  const std::string engines = R"("octree-cpu", "octree-cpu[levels=A]", "hash-cpu", "all-pairs")";
  const std::string d = planned(folder, engines);
  EXPECT_EQ(run_program({"run", d, "--shard", "1/2"}).exit_code, 0);
  const Ended half = run_program({"merge", d});
  EXPECT_EQ(half.exit_code, 3);
  EXPECT_NE(half.out.find("8 cells planned, 4 missing"), std::string::npos) << half.out;
  EXPECT_EQ(run_program({"run", d, "--shard", "2/2"}).exit_code, 0);
  const Ended again = run_program({"run", d, "--shard", "1/1"});
  EXPECT_NE(again.out.find("0 cells done, 8 done before"), std::string::npos) << again.out;
  const Ended merged = run_program({"merge", d});
  EXPECT_EQ(merged.exit_code, 0) << merged.out;

  Digests whole;
  for (const char* scene : {"freefall:cube:5", "freefall:cube:30"}) {
    const std::string out = (folder / scene).string();
    ASSERT_EQ(run_program({"run", scene, "--frames", "20", "--engine", "octree-cpu", "--engine", "octree-cpu[levels=A]",
                           "--engine", "hash-cpu", "--engine", "all-pairs", "--out", out})
                  .exit_code,
              0);
    whole.merge(digests_in(out));
  }
  EXPECT_EQ(digests_in(d), whole);
  EXPECT_EQ(whole.size(), 8U);
}

TEST(CampaignRun, ACrashIsAResultAndIsListed) {
  const ScratchFolder folder;
  const std::string d = planned(folder, "\"octree-cpu\", \"" + kWrong + "[fault=1]\"");
  EXPECT_EQ(run_program({"run", d, "--shard", "1/1"}).exit_code, 0);
  const Ended merged = run_program({"merge", d});
  EXPECT_EQ(merged.exit_code, 3);
  EXPECT_NE(merged.out.find("0 missing"), std::string::npos) << merged.out;
  EXPECT_NE(merged.out.find("2 crashed"), std::string::npos) << merged.out;
  EXPECT_NE(merged.out.find("signal 6"), std::string::npos) << merged.out;
}

TEST(CampaignRun, AKilledCellIsDoneAgain) {
  const ScratchFolder folder;
  // It hangs until the limit, so that there is time to kill it.
  const std::string d = planned(folder, "\"" + kWrong + "[fault=2]\"", "time_limit_s = 2\n");
  const pid_t running = start_program(folder, {"run", d, "--shard", "1/2"});
  bool was_begun = false;
  for (int k = 0; k < 300 && !was_begun; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "d/cells", ignored))
      was_begun |= entry.path().extension() == ".part";
  }
  EXPECT_TRUE(was_begun);
  kill(running, SIGKILL);
  EXPECT_EQ(wait_for(folder, running).exit_code, -1);
  // Its children were ended with it, so they write nothing into the folder in which the next try begins. Their own
  // limits would be 2 s and 30 s.
  for (int k = 0; k < 100 && processes_about(d) > 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(processes_about(d), 0);
  const Ended merged = run_program({"merge", d});
  EXPECT_NE(merged.out.find("begun and not finished"), std::string::npos) << merged.out;
  EXPECT_NE(merged.out.find("not begun"), std::string::npos) << merged.out;
  const Ended again = run_program({"run", d, "--shard", "1/1"});
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  const Ended whole = run_program({"merge", d});
  EXPECT_NE(whole.out.find("2 cells planned, 0 missing"), std::string::npos) << whole.out;
  EXPECT_NE(whole.out.find("2 timed out"), std::string::npos) << whole.out;
}

TEST(CampaignRun, TimedCellsHaveSamples) {
  const ScratchFolder folder;
  const std::string d = planned(folder, "\"octree-cpu\"", "repetitions = 2\n");
  EXPECT_EQ(run_program({"run", d, "--shard", "1/1"}).exit_code, 0);
  EXPECT_EQ(run_program({"merge", d}).exit_code, 0);
  const auto rows = core::read_rows(d);
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows.value().samples.size(), 4U);
  EXPECT_EQ(rows.value().verdicts.size(), 2U);
}

// Two processes and a merge give what `paper` gives in one run: the same rows but for the times.
TEST(CampaignRun, ThePapersExperimentsAreACampaign) {
  const ScratchFolder folder;
  std::ofstream(folder / "p.toml") << "name = \"paper\"\npaper = [\"table5\", \"tableA1\"]\nengine = \"octree-cpu\"\n"
                                      "frames = 30\nrepetitions = 2\nstand_in = true\n"
                                      "[vary]\nmodels = [\"dragon\"]\ncounts = [4]\n";
  const std::string d = (folder / "d").string();
  ASSERT_EQ(run_program({"plan", (folder / "p.toml").string(), "--out", d}).exit_code, 0);
  EXPECT_EQ(run_program({"run", d, "--shard", "1/2"}).exit_code, 0);
  EXPECT_NE(run_program({"merge", d}).out.find("5 cells planned, 2 missing"), std::string::npos);
  EXPECT_EQ(run_program({"run", d, "--shard", "2/2"}).exit_code, 0);
  EXPECT_NE(run_program({"run", d, "--shard", "1/1"}).out.find("0 cells done, 5 done before"), std::string::npos);
  EXPECT_EQ(run_program({"merge", d}).exit_code, 0);
  const Ended alone =
      run_program({"paper", "table5", "tableA1", "--engine", "octree-cpu", "--frames", "30", "--runs", "2", "--models",
                   "dragon", "--counts", "4", "--stand-in", "--out", (folder / "o").string()});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  auto merged = bench::paper::read_paper_rows(folder / "d/rows.json");
  auto whole = bench::paper::read_paper_rows(folder / "o/rows.json");
  ASSERT_TRUE(merged.ok() && whole.ok());
  ASSERT_EQ(merged.value().size(), 5U);
  ASSERT_EQ(whole.value().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto& [a, b] = std::tie(merged.value()[k], whole.value()[k]);
    EXPECT_EQ(a.stamp.label(), b.stamp.label());
    EXPECT_EQ(a.experiments, b.experiments);
    EXPECT_EQ(a.final_digest, b.final_digest);
    EXPECT_NE(a.final_digest, 0U);
    EXPECT_EQ(a.runs.size(), 2U);
    EXPECT_TRUE(a.is_admitted && b.is_admitted) << a.refusal << b.refusal;
  }
  // Both folders are shown by the report: rows of cells and verdicts, and the paper's tables.
  const std::string page = (folder / "page.html").string();
  EXPECT_EQ(run_program({"report", d, "--html", page}).exit_code, 0);
  EXPECT_NE(read_text(page).find("id=\"paper-table5\""), std::string::npos);
  EXPECT_EQ(run_program({"report", (folder / "o").string(), "--html", page}).exit_code, 0);
  EXPECT_NE(read_text(page).find("id=\"paper-table5\""), std::string::npos);
}

// As in the nightly run: a baseline beside each cell, and timed processes.
TEST(CampaignRun, CellsAreHeldAgainstABaselineAndTimedInProcesses) {
  const ScratchFolder folder;
  const std::string d =
      planned(folder, R"("octree-cpu", "all-pairs")", "against = \"all-pairs\"\nrepetitions = 1\nprocesses = 2\n");
  EXPECT_EQ(run_program({"run", d, "--shard", "1/1"}).exit_code, 0);
  EXPECT_EQ(run_program({"merge", d}).exit_code, 0);
  const auto rows = core::read_rows(d);
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows.value().cells.size(), 4U) << "the baseline of each scene is one row";
  EXPECT_EQ(rows.value().samples.size(), 2U * 2U * 2U);
  bool has_baseline = false;
  for (const core::CellVerdicts& verdicts : rows.value().verdicts)
    for (const core::Verdict& verdict : verdicts.verdicts) has_baseline |= !verdict.baseline.empty();
  EXPECT_TRUE(has_baseline);
}

TEST(CampaignRun, OtherBuildsAndUnequalTwinsAreRefused) {
  const ScratchFolder folder;
  const std::string d = planned(folder, R"("octree-cpu", "all-pairs")");
  ASSERT_EQ(run_program({"run", d, "--shard", "1/1"}).exit_code, 0);
  // all-pairs recorded octree-cpu as its driver: the same stamp twice.
  const auto refused_with = [&](auto&& change) {
    std::string line = "accepted";
    for (const auto& entry : std::filesystem::directory_iterator(folder / "d/cells")) {
      if (!entry.is_directory()) continue;
      auto rows = core::read_rows(entry.path());
      EXPECT_TRUE(rows.ok());
      const std::vector<core::Cell> sound = rows.value().cells;
      if (sound.size() < 2) continue;
      std::vector<core::Cell> changed = sound;
      for (core::Cell& cell : changed)
        if (cell.stamp.engine == "octree-cpu") change(cell);
      EXPECT_TRUE(core::write_cells(entry.path() / "cells.json", changed).ok());
      const auto merged = bench::campaign::merge_cells(d, d);
      if (!merged.ok()) line = merged.error().line();
      EXPECT_TRUE(core::write_cells(entry.path() / "cells.json", sound).ok());
    }
    return line;
  };
  EXPECT_EQ(refused_with([](core::Cell&) {}), "accepted");
  EXPECT_NE(refused_with([](core::Cell& cell) { cell.stamp.broadside_build = "older"; }).find("another build"),
            std::string::npos);
  EXPECT_NE(refused_with([](core::Cell& cell) { ++cell.digests.begin()->second; }).find("another digest"),
            std::string::npos);
}

TEST(CampaignRun, BadUseIsOneClearLine) {
  const ScratchFolder folder;
  const std::string d = planned(folder, "\"octree-cpu\"");
  const auto refused = [](const std::vector<std::string>& arguments) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.out;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    return ended.err;
  };
  EXPECT_NE(refused({"run", d, "--shard", "3/2"}).find("write i/n"), std::string::npos);
  EXPECT_NE(refused({"run", d, "--cell", "nope"}).find("there is no cell nope"), std::string::npos);
  EXPECT_NE(refused({"run", folder.text(), "--shard", "1/1"}).find("no manifest"), std::string::npos);
  EXPECT_NE(refused({"run", "freefall:cube:5"}).find("no engine was named"), std::string::npos);
  EXPECT_NE(refused({"plan", (folder / "none.toml").string()}).find("none.toml"), std::string::npos);
  EXPECT_NE(refused({"merge", folder.text()}).find("no manifest"), std::string::npos);
}

}  // namespace
}  // namespace broadside::tests
