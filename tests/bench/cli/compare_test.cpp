// compare, history, time in processes and run's output, as a user sees them.
#include <gtest/gtest.h>
#include <pty.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

std::string program_path() {
  const char* program = std::getenv("BROADSIDE_PROGRAM");
  return program == nullptr ? "broadside" : program;
}

// One build against itself: seven pairs are enough for a decision, and with so large a delta the build cannot be
// "slower".
TEST(Compare, TwoBuildsInTurnsLeaveRowsOfBothAndAVerdict) {
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  const Ended ended = run_program({"compare", "--interleave", program_path(), program_path(), "errata:E4", "--frames",
                                   "20", "--processes", "7", "--delta", "5", "--out", out, "--json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  const auto report = nlohmann::json::parse(ended.out);
  EXPECT_EQ(report["format"], "broadside-comparison");
  ASSERT_EQ(report["times"].size(), 1U);
  EXPECT_EQ(report["times"][0]["speed"], "same") << ended.out;
  EXPECT_EQ(report["times"][0]["base_processes"], 7);
  EXPECT_EQ(report["times"][0]["paired"], true);
  EXPECT_GT(report["same_counters"], 0);
  // The measured files stay and can be compared again.
  const Ended again = run_program({"compare", out + "/base", out + "/head", "--delta", "5"});
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_NE(again.out.find("7 and 7 processes in turns"), std::string::npos) << again.out;
}

// With a delta of 0, equal builds can hardly be shown to be the same, so more pairs are run after the first ones.
TEST(Compare, WhatIsNotToldGetsMoreProcesses) {
  const ScratchFolder folder;
  const Ended ended = run_program({"compare", "--interleave", program_path(), program_path(), "errata:E4", "--frames",
                                   "20", "--processes", "6", "--most-processes", "15", "--delta", "0", "--out",
                                   (folder / "out").string(), "--json"});
  const auto report = nlohmann::json::parse(ended.out);
  EXPECT_EQ(report["looks"], 3);
  ASSERT_EQ(report["times"].size(), 1U);
  const std::string speed = report["times"][0]["speed"];
  const int processes = report["times"][0]["head_processes"];
  EXPECT_EQ(report["times"][0]["base_processes"], processes);
  if (speed == "INCONCLUSIVE") {
    EXPECT_EQ(processes, 15);
    EXPECT_EQ(ended.exit_code, 3);
  } else {
    EXPECT_TRUE(processes == 6 || processes == 12 || processes == 15) << processes;
  }
}

// A program without the option for turns: its processes run whole, one after the other, and the comparison says so.
TEST(Compare, AProgramThatKnowsNoTurnsIsComparedAllTheSame) {
  const ScratchFolder folder;
  const std::filesystem::path old = folder / "old";
  std::ofstream(old) << "#!/bin/sh\n[ \"$2\" = --help ] && exit 0\nexec \"" << program_path() << "\" \"$@\"\n";
  std::filesystem::permissions(old, std::filesystem::perms::owner_all);
  const Ended ended = run_program({"compare", "--interleave", old.string(), program_path(), "errata:E4", "--frames",
                                   "20", "--processes", "7", "--delta", "5", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.err.find("cannot take turns"), std::string::npos) << ended.err;
}

// The build that always comes second would be measured on a warmer machine, so the builds change places from pair to
// pair.
TEST(Compare, TheBuildsTakeTurnsInComingFirst) {
  const ScratchFolder folder;
  const std::filesystem::path log = folder / "log";
  for (const char* name : {"base", "head"}) {
    std::ofstream(folder / name) << "#!/bin/sh\n[ \"$2\" = --help ] && exit 0\n[ \"$1\" = time ] && echo " << name
                                 << " >> '" << log.string() << "'\nexec \"" << program_path() << "\" \"$@\"\n";
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
  }
  run_program({"compare", "--interleave", (folder / "base").string(), (folder / "head").string(), "errata:E4",
               "--frames", "20", "--processes", "6", "--most-processes", "6", "--delta", "5", "--out",
               (folder / "out").string()});
  std::ifstream lines(log);
  std::string order;
  for (std::string name; lines >> name;) order += name[0];
  EXPECT_EQ(order, "bhhbbhhbbhhb");
}

TEST(Compare, BadInputIsOneLine) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"compare", "only-one"},
           {"compare", "--interleave", program_path(), program_path()},
           {"compare", "--interleave", "/no/such/program", program_path(), "errata:E4"},
           {"compare", "no-base", "no-head"},
           {"history", "no/such/file"},
           {"time", "errata:E4", "--turns", "first:99:0"},
           {"report", "absent", "--csv", "x"}}) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments[1] << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
  const Ended wrong =
      run_program({"compare", "--interleave", "/bin/false", program_path(), "errata:E4", "--out", "/proc/nowhere"});
  EXPECT_EQ(wrong.exit_code, 2) << wrong.err;
}

TEST(Time, InProcessesNamesAsManyProcesses) {
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  ASSERT_EQ(run_program({"run", "errata:E4", "--frames", "20", "--engine", "octree-cpu", "--out", out}).exit_code, 0);
  const Ended ended = run_program({"time", "errata:E4", "--frames", "20", "--engine", "octree-cpu", "--processes", "3",
                                   "--repetitions", "2", "--out", out + "/samples.json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto samples = core::read_samples(out + "/samples.json");
  ASSERT_TRUE(samples);
  std::set<std::uint64_t> processes;
  for (const core::Sample& sample : samples.value()) processes.insert(sample.process);
  EXPECT_EQ(samples.value().size(), 6U);
  EXPECT_EQ(processes.size(), 3U);
  EXPECT_FALSE(processes.contains(0));
}

TEST(History, AppendsAndShows) {
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  const std::string file = (folder / "history.sqlite").string();
  ASSERT_EQ(run_program({"run", "errata:E4", "--frames", "20", "--engine", "octree-cpu", "--out", out}).exit_code, 0);
  EXPECT_EQ(run_program({"history", file, "--add", out}).out.find(out + ": run 1, "), 0U);
  EXPECT_NE(run_program({"history", file, "--add", out}).out.find("is already run 1"), std::string::npos);
  const Ended shown = run_program({"history", file});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_NE(shown.out.find("counter level stage: box tests: 1 run"), std::string::npos) << shown.out;
  EXPECT_EQ(nlohmann::json::parse(run_program({"history", file, "--json"}).out)["format"], "broadside-history");
}

TEST(Run, JsonIsOnTheOutputAloneAndTheTableFitsAHundredColumns) {
  const ScratchFolder folder;
  const Ended ended = run_program({"run", "errata:E4", "--frames", "5", "--engine", "octree-cpu", "--engine",
                                   "all-pairs", "--json", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0);
  const auto report = nlohmann::json::parse(ended.out);
  ASSERT_EQ(report["cells"].size(), 2U);
  EXPECT_EQ(report["cells"][0]["label"], "octree-cpu");
  EXPECT_EQ(report["cells"][0]["frames"], 5);
  EXPECT_GT(report["cells"][0]["counters"]["level stage: pairs tested"], 0);
  const Ended table =
      run_program({"run", "errata:E4", "--frames", "5", "--engine", "octree-cpu", "--out", (folder / "out").string()});
  std::istringstream lines(table.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110U) << line;
  EXPECT_NE(table.out.find("1 of 1 cell recorded in"), std::string::npos) << table.out;
}

// The output of a run on a terminal; empty where no terminal can be opened.
std::string on_terminal(const std::vector<std::string>& arguments, bool no_color) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0) return {};
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    if (no_color) setenv("NO_COLOR", "1", 1);
    std::vector<std::string> all{program_path()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& a : all) argv.push_back(a.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(terminal, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return text;
}

TEST(Run, ATerminalShowsALinePerEngineInColorUnlessNoColorIsSet) {
  const ScratchFolder folder;
  const std::vector<std::string> arguments{
      "run",        "errata:E4", "--frames",    "5",     "--engine",
      "octree-cpu", "--engine",  "bullet-dbvt", "--out", (folder / "out").string()};
  const std::string colored = on_terminal(arguments, false);
  if (colored.empty()) GTEST_SKIP() << "no pseudo-terminal here: /dev/ptmx and /dev/pts are needed";
  EXPECT_NE(colored.find("[1 of 2] octree-cpu: \033[32mrecorded, 5 frames in "), std::string::npos) << colored;
  EXPECT_NE(colored.find("[2 of 2] bullet-dbvt: "), std::string::npos) << colored;
  const std::string plain = on_terminal(arguments, true);
  EXPECT_NE(plain.find("[1 of 2] octree-cpu: recorded"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("\033[3"), std::string::npos) << plain;
  const Ended piped = run_program(arguments);
  EXPECT_EQ(piped.err.find("[1 of 2]"), std::string::npos) << "a log has the table";
}

}  // namespace
}  // namespace broadside::tests
