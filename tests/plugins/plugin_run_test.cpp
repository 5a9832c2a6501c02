// Plug-ins through the program, as a user would name them: the harness lives on whatever they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>

#include "tests/command_line/program.hpp"

namespace broadside::tests {
namespace {

const std::string kFolder = BROADSIDE_PLUGIN_DIR;

std::string wrong(int fault) {
  return kFolder + "/libwrong_engine.so[fault=" + std::to_string(fault) + "]";
}

struct Recorded {
  Ended run;
  Ended check;  // of the plug-in's trace, when there is one
};

Recorded recorded(const std::string& engine, const std::string& trace) {
  const ScratchFolder folder;
  Recorded both;
  both.run = run_program(
      {"run", "freefall:cube:30", "--frames", "60", "--engine", engine, "--time-limit", "5", "--out", folder.text()});
  if (std::filesystem::exists(folder / trace)) both.check = run_program({"check", (folder / trace).string()});
  return both;
}

// The word after the validator's name in the table that check prints.
std::string verdict_of(const std::string& validator, const std::string& table) {
  std::istringstream words(table.substr(std::min(table.find("\n" + validator + " "), table.size())));
  std::string name;
  std::string verdict;
  words >> name >> verdict;
  return verdict;
}

TEST(PluginRun, TheExampleIsRecordedAndJudged) {
  const Recorded both = recorded(kFolder + "/libsweep.so", "example-sweep.h5");
  EXPECT_EQ(both.run.exit_code, 0) << both.run.err;
  EXPECT_EQ(both.check.exit_code, 0) << both.check.out;
  EXPECT_EQ(verdict_of("candidate-set", both.check.out), "pass") << both.check.out;
}

// The four commands of the walk-through as they stand there, with the example and a small scene: the page proves the
// times.
TEST(PluginRun, TheWalkThroughEndsInAProvenReport) {
  const ScratchFolder folder;
  const std::string text = read_text(std::string(BROADSIDE_SOURCE_DIR) + "/core/plugin/README.md");
  const std::string head = "## Twenty minutes: the report\n\n";
  const std::size_t at = text.find(head);
  ASSERT_NE(at, std::string::npos);
  std::istringstream lines(text.substr(at + head.size()));
  std::string script = "set -e\ncd '" + folder.text() + "'\nbroadside() { \"$BROADSIDE_PROGRAM\" \"$@\"; }\n";
  int commands = 0;
  for (std::string line; std::getline(lines, line) && line.starts_with("    broadside "); ++commands) {
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"./libmine.so", kFolder + "/libsweep.so"},
                                   {"freefall:bunny:50", "freefall:cube:20 --frames 60"}})
      if (const std::size_t place = line.find(from); place != std::string::npos) line.replace(place, from.size(), to);
    script += line + "\n";
  }
  ASSERT_EQ(commands, 4);
  std::ofstream(folder / "walk.sh") << script;
  ASSERT_EQ(std::system(("bash '" + (folder / "walk.sh").string() + "' >/dev/null 2>&1").c_str()), 0) << script;
  const std::string page = read_text(folder / "out/mine/report.html");
  EXPECT_NE(page.find("verdicts passed"), std::string::npos);
  EXPECT_NE(page.find("<b>2</b> times admitted"), std::string::npos) << "of the example and of Bullet";
}

TEST(PluginRun, ADroppedAndADoubledPairFailTheCandidateSet) {
  for (const int fault : {9, 10}) {
    const Recorded both = recorded(wrong(fault), "wrong-engine+fault=" + std::to_string(fault) + ".h5");
    EXPECT_EQ(both.run.exit_code, 0) << both.run.err;
    EXPECT_EQ(both.check.exit_code, 1) << both.check.out;
    EXPECT_EQ(verdict_of("candidate-set", both.check.out), "FAIL") << both.check.out;
  }
}

TEST(PluginRun, WhatDiesHangsOrBreaksTheRulesIsACellThatSaysSo) {
  const auto outcome = [](int fault) {
    const Recorded both = recorded(wrong(fault), "");
    EXPECT_EQ(both.run.exit_code, 3) << fault << ": " << both.run.out << both.run.err;
    return both.run.out;
  };
  EXPECT_NE(outcome(1).find("signal 6"), std::string::npos);   // abort
  EXPECT_NE(outcome(3).find("failed"), std::string::npos);     // a pair out of range
  EXPECT_NE(outcome(6).find("failed"), std::string::npos);     // counts more than it writes
  EXPECT_NE(outcome(7).find("signal 11"), std::string::npos);  // writes behind its buffer
  EXPECT_NE(outcome(8).find("signal 11"), std::string::npos);  // writes into its input
  EXPECT_NE(outcome(11).find("failed"), std::string::npos);    // an absurd count
  EXPECT_NE(outcome(12).find("the moon is full"), std::string::npos);
}

TEST(PluginRun, AHangEndsAtTheTimeLimit) {
  const ScratchFolder folder;
  const Ended ended = run_program(
      {"run", "freefall:cube:3", "--frames", "2", "--engine", wrong(2), "--time-limit", "1", "--out", folder.text()});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.out.find("timed out"), std::string::npos) << ended.out;
}

TEST(PluginRun, BadPathsAreOneClearLine) {
  const auto refused = [](const std::string& engine) {
    const Ended ended = run_program({"pairs", "boxes:uniform:10", "--engine", engine});
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    return ended.err;
  };
  EXPECT_NE(refused("./nope.so").find("there is no such file"), std::string::npos);
  EXPECT_NE(refused(kFolder).find("there is no such file"), std::string::npos);
  EXPECT_NE(refused(kFolder + "/libempty_plugin.so").find("exports no broadside_engine_v1"), std::string::npos);
  EXPECT_NE(refused(kFolder + "/liblater_plugin.so").find("version 2"), std::string::npos);
  EXPECT_NE(refused(kFolder + "/libsweep.so[x=1]").find("unknown setting 'x'"), std::string::npos);
}

}  // namespace
}  // namespace broadside::tests
