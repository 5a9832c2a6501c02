// The motion study as a user runs it: every kind is answered, wrong answers are saved and repeat, bad files say where.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::uint64_t verdict(const json& bin, const std::string& name) {
  return bin.at("verdicts").value(name, std::uint64_t{0});
}

TEST(AgreeMotion, EveryKindIsAnswered) {
  for (const std::string kind : {"vertex-face", "edge-edge", "boxes", "spheres", "capsules", "convex", "meshes"}) {
    const ScratchFolder folder;
    const Ended ended = run_program(
        {"agree", "--motion", kind, "--n", "24", "--json", "--time-limit", "5", "--out", (folder / "out").string()});
    ASSERT_EQ(ended.exit_code, 0) << kind << ": " << ended.err;
    const json out = json::parse(ended.out);
    EXPECT_EQ(out.at("motion"), kind);
    EXPECT_GE(out.at("engines").size(), 4U);
    for (const json& engine : out.at("engines")) {
      EXPECT_EQ(engine.at("all").at("queries"), 24) << kind << " " << engine.at("engine");
      EXPECT_NE(engine.at("build").get<std::string>(), "");
    }
    EXPECT_TRUE(fs::exists(folder / "out" / ("motion-" + kind + ".json")));
  }
}

TEST(AgreeMotion, TheArbiterAndOurOwnAreNeverLate) {
  const ScratchFolder folder;
  const Ended ended = run_program({"agree", "--motion", "edge-edge", "--n", "600", "--json", "--engine", "exact-motion",
                                   "--engine", "feature-impact", "--out", (folder / "out").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const json& engine : json::parse(ended.out).at("engines")) {
    EXPECT_GT(engine.at("all").at("touches").get<int>(), 100);
    EXPECT_EQ(verdict(engine.at("all"), "missed"), 0U);
    EXPECT_EQ(engine.at("all").at("after_the_touch"), 0);
    EXPECT_LT(engine.at("all").at("early_median").get<double>(), 1e-6);
  }
}

// FCL's queries of features miss all touches of edges that stay parallel; sampling misses fast motions.
TEST(AgreeMotion, AMissIsSavedAndRepeats) {
  for (const auto& [kind, engine, good] :
       {std::array<std::string, 3>{"edge-edge", "fcl-features", "feature-impact"},
        std::array<std::string, 3>{"boxes", "fcl-motion[solver=naive]", "exact-motion"}}) {
    const ScratchFolder folder;
    const Ended ended =
        run_program({"agree", "--motion", kind, "--n", "60", "--engine", engine, "--out", (folder / "out").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.out.find("repeat: broadside agree --motion " + kind + " --case"), std::string::npos) << ended.out;
    std::string saved;
    for (const auto& entry : fs::directory_iterator(folder / "out" / "cases"))
      if (entry.path().filename().string().find("missed") != std::string::npos) saved = entry.path().string();
    ASSERT_FALSE(saved.empty()) << ended.out;
    const Ended again = run_program({"agree", "--motion", kind, "--case", saved, "--engine", engine});
    EXPECT_EQ(again.exit_code, 1) << again.out << again.err;
    EXPECT_NE(again.out.find("missed, no touch"), std::string::npos) << again.out;
    const Ended right = run_program({"agree", "--motion", kind, "--case", saved, "--engine", good});
    EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  }
}

TEST(AgreeMotion, TheNumberOfProcessesChangesNoVerdict) {
  std::vector<json> verdicts;
  for (const std::string processes : {"1", "3"}) {
    const ScratchFolder folder;
    const Ended ended = run_program({"agree", "--motion", "spheres", "--n", "60", "--json", "--processes", processes,
                                     "--engine", "bullet-cast", "--out", folder.text()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    json bins;
    for (const auto& [name, bin] : json::parse(ended.out).at("engines").at(0).at("by_family").items())
      bins[name] = bin.at("verdicts");
    verdicts.push_back(bins);
  }
  EXPECT_EQ(verdicts[0], verdicts[1]);
}

TEST(AgreeMotion, BadUsageAndBadFilesAreOneLine) {
  const ScratchFolder folder;
  std::ofstream(folder / "bad.csv") << "1,1,1,0,1,1,1\n";
  const std::string bad = (folder / "bad.csv").string();
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"agree", "--motion", "donuts"},
                                             {"agree", "--motion", "boxes", "--mesh", "bunny"},
                                             {"agree", "--motion", "boxes", "--engine", "fcl-tree"},
                                             {"agree", "--motion", "boxes", "--engine", "fcl-motion[solver=best]"},
                                             {"agree", "--motion", "boxes", "--case", "/no/such/file.json"},
                                             {"agree", "--motion", "vertex-face", "--case", bad}}) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments.back() << ended.out;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
  EXPECT_NE(run_program({"agree", "--motion", "vertex-face", "--case", bad}).err.find("line 1"), std::string::npos);
}

TEST(AgreeMotion, AnEngineOfOtherQueriesIsAbsentWithTheReason) {
  const ScratchFolder folder;
  const Ended ended = run_program(
      {"agree", "--motion", "boxes", "--n", "4", "--engine", "feature-impact", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.out.find("it answers no queries of boxes"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace broadside::tests
