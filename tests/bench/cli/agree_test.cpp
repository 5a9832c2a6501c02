// The agreement study as a user runs it: tables, rows, saved inputs that repeat, libraries that crash.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Agree, EveryKindIsAnsweredAndRowed) {
  for (const std::string kind : {"boxes", "spheres", "capsules", "convex", "meshes"}) {
    const ScratchFolder folder;
    const Ended ended = run_program(
        {"agree", "--pairs", kind, "--n", "20", "--json", "--time-limit", "2", "--out", (folder / "out").string()});
    ASSERT_EQ(ended.exit_code, 0) << kind << ": " << ended.err;
    const json out = json::parse(ended.out);
    ASSERT_FALSE(out.at("engines").empty());
    for (const json& engine : out.at("engines")) {
      std::uint64_t pairs = 0;
      std::uint64_t wrong = 0;
      for (const auto& [name, bin] : engine.at("by_separation").items()) {
        pairs += bin.at("pairs").get<std::uint64_t>();
        wrong += bin.at("verdicts").value("missed", 0) + bin.at("verdicts").value("extra", 0);
      }
      EXPECT_EQ(pairs, 20U) << kind << " " << engine.at("engine");
      EXPECT_LE(wrong, 2U) << kind << " " << engine.at("engine") << ": apart or touching is not in question here";
      EXPECT_NE(engine.at("build").get<std::string>().find_first_of("0123456789"), std::string::npos);
    }
    const auto rows = core::read_rows(folder / "out");
    ASSERT_TRUE(rows.ok());
    EXPECT_EQ(rows.value().cells.size(), out.at("engines").size());
    EXPECT_TRUE(rows.value().cells[0].notes.contains("agreement: s4 far"));
  }
}

// The arbiter against itself: everything agrees by construction of the pairs.
TEST(Agree, TheArbiterAgreesWithItself) {
  const ScratchFolder folder;
  const Ended ended = run_program({"agree", "--pairs", "convex", "--n", "80", "--engine", "exact-shapes[threads=1]",
                                   "--json", "--out", (folder / "out").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json bins = json::parse(ended.out).at("engines").at(0).at("by_separation");
  int filled = 0;
  for (const auto& [name, bin] : bins.items()) {
    filled += bin.at("pairs").get<int>() > 4 ? 1 : 0;
    for (const auto& [verdict, count] : bin.at("verdicts").items())
      EXPECT_TRUE(verdict == "agree" || verdict == "touching band") << verdict << " " << count;
  }
  EXPECT_GE(filled, 4) << "pairs are spread over separations";
}

TEST(Agree, AWrongAnswerIsSavedAndRepeats) {
  const ScratchFolder folder;
  // MPR's depth is along the line of centers: it is off on most deep boxes.
  const std::string engine = "ccd[algorithm=mpr,shape=primitive,threads=1]";
  const Ended ended =
      run_program({"agree", "--pairs", "boxes", "--n", "40", "--engine", engine, "--out", (folder / "out").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("repeat: broadside agree --case"), std::string::npos) << ended.out;
  std::string saved;
  for (const auto& entry : fs::directory_iterator(folder / "out" / "cases"))
    if (entry.path().filename().string().find("depth-off") != std::string::npos) saved = entry.path().string();
  ASSERT_FALSE(saved.empty());
  const Ended again = run_program({"agree", "--case", saved, "--engine", engine});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.out.find("depth off"), std::string::npos) << again.out;
  const Ended arbiter = run_program({"agree", "--case", saved, "--engine", "exact-shapes"});
  EXPECT_EQ(arbiter.exit_code, 0) << arbiter.out;
}

TEST(Agree, KissingBoxesRunToTheEndWhateverDies) {
  const ScratchFolder folder;
  const Ended ended = run_program({"agree", "--pairs", "kissing", "--n", "300", "--json", "--engine",
                                   "fcl-shapes[solver=indep,threads=1]", "--out", (folder / "out").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json engine = json::parse(ended.out).at("engines").at(0);
  std::uint64_t pairs = 0;
  for (const auto& [name, bin] : engine.at("by_separation").items()) pairs += bin.at("pairs").get<std::uint64_t>();
  EXPECT_EQ(pairs, 300U);
}

// A pair follows from its index alone and an answer from its pair, so results do not depend on the number of processes.
TEST(Agree, TheNumberOfProcessesChangesNoVerdict) {
  std::vector<json> verdicts;
  for (const std::string processes : {"1", "3"}) {
    const ScratchFolder folder;
    const Ended ended = run_program({"agree", "--pairs", "kissing", "--n", "200", "--json", "--processes", processes,
                                     "--engine", "fcl-shapes[solver=indep,threads=1]", "--out", folder.text()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    json bins;
    const json engine = json::parse(ended.out).at("engines").at(0);
    for (const auto& [name, bin] : engine.at("by_separation").items()) bins[name] = bin.at("verdicts");
    verdicts.push_back(bins);
  }
  EXPECT_EQ(verdicts[0], verdicts[1]);
}

// Where two balls share their center, FCL's EPA goes on refining the whole ball. The limit on processor time ends the
// query, however busy the machine is, and the time-out is a verdict like the others.
TEST(Agree, AQueryThatDoesNotComeBackIsATimeOut) {
  const ScratchFolder folder;
  const Ended ended =
      run_program({"agree", "--pairs", "spheres", "--n", "40", "--json", "--time-limit", "0.02", "--engine",
                   "fcl-shapes[threads=1]", "--engine", "exact-shapes[threads=1]", "--out", folder.text()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json engines = json::parse(ended.out).at("engines");
  const json centers = engines.at(0).at("by_degeneracy").at("coincident centers");
  EXPECT_EQ(centers.at("verdicts").value("time-out", 0), centers.at("pairs").get<int>()) << centers;
  EXPECT_TRUE(engines.at(0).at("words").contains("no answer within 0.02 s"));
  for (const auto& [name, bin] : engines.at(1).at("by_separation").items())
    EXPECT_FALSE(bin.at("verdicts").contains("time-out")) << "the arbiter in its own skin";
}

TEST(Agree, BadUsageIsOneLine) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"agree", "--pairs", "donuts"},
                                             {"agree", "--n", "0"},
                                             {"agree", "--pairs", "boxes", "--mesh", "bunny"},
                                             {"agree", "--engine", "fcl-shape"},
                                             {"agree", "--case", "/no/such/file.json"}}) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments.back() << ended.out;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
}

TEST(Agree, ADamagedCaseSaysWhere) {
  const ScratchFolder folder;
  const fs::path file = folder / "case.json";
  std::ofstream(file) << R"({"format": "broadside-pair", "version": 1, "is_convex": true, "a": {}})";
  const Ended ended = run_program({"agree", "--case", file.string()});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("case.json"), std::string::npos);
}

TEST(Agree, AnEngineThatCannotTakeTheShapesIsAbsentWithTheReason) {
  const ScratchFolder folder;
  const Ended ended = run_program(
      {"agree", "--pairs", "meshes", "--n", "4", "--engine", "fcl-shapes", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.out.find("no box, sphere, capsule or convex body"), std::string::npos) << ended.out;
}

TEST(References, PairsAndTimesComeFromProcessesWithLimits) {
  const Ended good = run_program({"pairs", "boxes:uniform:2000", "--engine", "all-pairs", "--engine", "fcl-tree",
                                  "--engine", "bullet-dbvt", "--json"});
  ASSERT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(json::parse(good.out).size(), 3U);
  const Ended late = run_program(
      {"pairs", "boxes:uniform:20000", "--engine", "octree-cpu", "--engine", "fcl-tree", "--time-limit", "0.001"});
  EXPECT_EQ(late.exit_code, 3);
  EXPECT_NE(late.out.find("no end after 0.001 s"), std::string::npos) << late.out;
  const Ended large = run_program({"pairs", "boxes:uniform:200000", "--engine", "fcl-tree", "--memory-limit", "64"});
  EXPECT_EQ(large.exit_code, 3) << large.out << large.err;
  EXPECT_NE(large.out.find("out of memory: "), std::string::npos) << large.out;
  EXPECT_NE(large.out.find("--memory-limit 64"), std::string::npos) << "what repeats it has its limit" << large.out;

  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  ASSERT_EQ(run_program({"run", "freefall:cube:8", "--frames", "10", "--engine", "octree-cpu", "--engine", "fcl-tree",
                         "--out", out})
                .exit_code,
            0);
  const Ended timed = run_program({"time", "freefall:cube:8", "--frames", "10", "--engine", "fcl-tree", "--repetitions",
                                   "2", "--out", out + "/samples.json"});
  EXPECT_EQ(timed.exit_code, 0) << timed.out << timed.err;
  const auto rows = core::read_rows(folder / "out");
  ASSERT_TRUE(rows.ok());
  ASSERT_EQ(rows.value().samples.size(), 2U);
  EXPECT_EQ(rows.value().samples[1].repetition, 1U);
  for (const core::Cell& cell : rows.value().cells)
    if (cell.stamp.engine == "fcl-tree") {
      EXPECT_EQ(cell.digests.rbegin()->second, rows.value().samples[0].final_digest);
    }
  const Ended timed_late = run_program({"time", "freefall:cube:8", "--frames", "10", "--engine", "fcl-tree",
                                        "--time-limit", "0.001", "--out", out + "/samples.json"});
  EXPECT_EQ(timed_late.exit_code, 3) << timed_late.out;
  EXPECT_NE(timed_late.err.find("no end after"), std::string::npos) << timed_late.err;
}

// The limit counts the memory that the engine's process needs for its work, not what the harness uses itself: 50,000
// bodies do not fit into 16 MiB.
TEST(References, AMemoryLimitOfARunIsItsEnginesOwn) {
  const ScratchFolder folder;
  const auto run = [&](const char* limit) {
    return run_program({"run", "freefall:cube:50000", "--frames", "2", "--engine", "bullet-dbvt", "--memory-limit",
                        limit, "--out", (folder / limit).string()});
  };
  const Ended small = run("16");
  EXPECT_EQ(small.exit_code, 3) << small.out << small.err;
  const auto rows = core::read_rows(folder / "16");
  ASSERT_TRUE(rows.ok());
  bool is_named = false;
  for (const core::Cell& cell : rows.value().cells)
    if (cell.stamp.engine == "bullet-dbvt") is_named = cell.notes.at("verdict on its process") == "out of memory";
  EXPECT_TRUE(is_named) << small.out;
  const Ended large = run("4000");
  EXPECT_EQ(large.exit_code, 0) << large.out << large.err;
}

}  // namespace
}  // namespace broadside::tests
