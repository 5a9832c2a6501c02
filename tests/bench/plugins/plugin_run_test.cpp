// Plug-ins through the program, as a user would name them: the harness survives whatever they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

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

// The four commands of the walk-through as written there, with the example and a small scene. Their times are admitted.
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

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// How an engine's process ended. Each command reports it in the same words, with the command that repeats it.
struct Fault {
  int number;
  std::string verdict;
  int exit_code_of_repeat;  // -1: a signal
};
const std::vector<Fault> kFaults{{1, "abort", -1}, {7, "crash", -1}, {12, "exception", 3}};

TEST(PluginRun, PairsNamesTheVerdictAndRepeatsIt) {
  for (const Fault& fault : kFaults) {
    const Ended ended = run_program({"pairs", "boxes:uniform:200", "--engine", wrong(fault.number), "--json"});
    EXPECT_EQ(ended.exit_code, 3) << ended.out;
    const nlohmann::json row = nlohmann::json::parse(ended.out).at(0);
    EXPECT_EQ(row.at("verdict"), fault.verdict) << ended.out;
    std::vector<std::string> repeat = words_of(row.at("repeat"));
    ASSERT_EQ(repeat.front(), "broadside");
    repeat.erase(repeat.begin());
    EXPECT_EQ(run_program(repeat).exit_code, fault.exit_code_of_repeat) << row.at("repeat");
  }
  const Ended late = run_program({"pairs", "boxes:uniform:200", "--engine", wrong(2), "--time-limit", "0.5", "--json"});
  EXPECT_EQ(nlohmann::json::parse(late.out).at(0).at("verdict"), "time-out") << late.out;
}

TEST(PluginRun, TimeAndRunNameTheVerdictAndRepeatIt) {
  const ScratchFolder folder;
  const std::vector<std::string> scene{"freefall:cube:30", "--frames", "20", "--out"};
  const auto command = [&](const std::string& name, int fault, const std::string& out) {
    return run_program({name, scene[0], scene[1], scene[2], scene[3], out, "--engine", wrong(fault)});
  };
  for (const Fault& fault : kFaults) {
    const std::string out = (folder / std::to_string(fault.number)).string();
    EXPECT_EQ(command("run", fault.number, out).exit_code, 3);
    const auto rows = core::read_rows(out);
    ASSERT_TRUE(rows.ok());
    const core::Cell& cell = rows.value().cells.back();
    EXPECT_EQ(cell.stamp.engine, "wrong-engine");
    EXPECT_EQ(cell.notes.at("verdict on its process"), fault.verdict);
    std::vector<std::string> repeat = words_of(cell.notes.at("repeat"));
    repeat.erase(repeat.begin());
    EXPECT_EQ(run_program(repeat).exit_code, fault.exit_code_of_repeat) << cell.notes.at("repeat");

    const Ended timed = command("time", fault.number, out + "/samples.json");
    EXPECT_EQ(timed.exit_code, 3);
    EXPECT_NE(timed.err.find(fault.verdict + ": "), std::string::npos) << timed.err;
    EXPECT_NE(timed.err.find("repeat: broadside time"), std::string::npos) << timed.err;
  }
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
