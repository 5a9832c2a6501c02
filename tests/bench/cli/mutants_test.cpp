// `broadside mutants` as a user runs it: which validator caught which mutant, and the exit code.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

TEST(MutantsCommand, CatchesEveryMutationAndBlamesNoSoundRun) {
  const ScratchFolder folder;
  const std::string file = (folder / "mutants.json").string();
  const Ended ended = run_program({"mutants", "--reduced", "--scenes", "4", "--json", file});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_EQ(ended.out.find("SURVIVED"), std::string::npos) << ended.out;
  std::ifstream stream(file);
  const auto report = nlohmann::json::parse(stream);
  EXPECT_EQ(report["mutations"], report["caught"]);
  EXPECT_GE(report["mutations"].get<int>(), 200);
  EXPECT_EQ(report["random scenes"], 8);  // four of the method, four whose bodies turn
  EXPECT_TRUE(report["false alarms"].empty());
}

TEST(MutantsCommand, OneByNameSaysWhoCaughtIt) {
  const Ended ended = run_program({"mutants", "--only", "printed-E6"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("friction-energy"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("1 of 1 mutations caught"), std::string::npos) << ended.out;
}

TEST(MutantsCommand, AnUnknownNameIsOneClearLine) {
  const Ended ended = run_program({"mutants", "--only", "printed-E66"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("unknown mutation"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("printed-E6"), std::string::npos) << ended.err;
}

TEST(TransformedScene, IsComparedByMetamorphicAndByNoOther) {
  const ScratchFolder folder;
  for (const char* scene : {"two-body:glancing", "two-body:glancing@renumbered"}) {
    const Ended ran = run_program({"run", scene, "--engine", "octree-cpu", "--out",
                                   (folder / (std::string(scene).ends_with("renumbered") ? "b" : "a")).string()});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
  }
  const std::string a = (folder / "a/octree-cpu.h5").string();
  const std::string b = (folder / "b/octree-cpu.h5").string();
  const std::string file = (folder / "verdicts.json").string();
  const Ended checked = run_program({"check", a, "--against", b, "--json", file});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  std::ifstream stream(file);
  const auto report = nlohmann::json::parse(stream);
  std::string with_baseline;
  for (const auto& row : report["rows"])
    for (const auto& verdict : row["verdicts"])
      if (!verdict["baseline"].get<std::string>().empty()) with_baseline += verdict["validator"].get<std::string>();
  EXPECT_EQ(with_baseline, "metamorphic");
  EXPECT_EQ(
      run_program({"run", "two-body:glancing@mirored-x", "--engine", "octree-cpu", "--out", folder.text()}).exit_code,
      2);
}

}  // namespace
}  // namespace broadside::tests
