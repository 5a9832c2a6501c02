// `broadside mutants` as a user runs it: who caught what, and the exit code that it leads to.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/command_line/program.hpp"

namespace broadside::tests {
namespace {

TEST(MutantsCommand, CatchesEveryMutationAndBlamesNoSoundRun) {
  const ScratchFolder folder;
  const std::string file = (folder / "mutants.json").string();
  const Ended ended = run_program({"mutants", "--reduced", "--scenes", "4", "--json", file});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_EQ(ended.out.find("SURVIVED"), std::string::npos) << ended.out;
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream);
  EXPECT_EQ(json["mutations"], json["caught"]);
  EXPECT_GE(json["mutations"].get<int>(), 200);
  EXPECT_EQ(json["random scenes"], 4);
  EXPECT_TRUE(json["false alarms"].empty());
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

}  // namespace
}  // namespace broadside::tests
