// Engines that are programs, run through Broadside as a user would name them. Right ones are judged; whatever a wrong
// one sends, or fails to send, becomes one clear line with the right exit code.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/rows.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

const std::string kSource = BROADSIDE_SOURCE_DIR;
const std::string kExamples = kSource + "/core/plugin/examples/";

std::string wrong(const std::string& fault) {
  return "python3 -B " + kSource + "/tests/bench/plugins/wrong_program.py " + fault;
}

// The one cell of a run over three cubes.
struct Outcome {
  Ended run;
  core::Cell cell;
};
Outcome outcome(const std::string& fault, const std::string& limit = "20") {
  const ScratchFolder folder;
  Outcome o;
  o.run = run_program({"run", "freefall:cube:3", "--frames", "5", "--engine", wrong(fault), "--time-limit", limit,
                       "--out", folder.text()});
  const auto rows = core::read_rows(folder.text());
  if (rows.ok() && !rows.value().cells.empty()) o.cell = rows.value().cells.back();
  return o;
}

TEST(ProgramRun, ARightOneIsRecorded) {
  const Outcome o = outcome("none");
  EXPECT_EQ(o.run.exit_code, 0) << o.run.out << o.run.err;
  EXPECT_EQ(o.cell.stamp.engine, "wrong-program");
  EXPECT_EQ(o.cell.frames, 5U);
}

TEST(ProgramRun, WhatIsNoEngineIsBadInputInOneLine) {
  const auto refused = [](const std::string& engine) {
    const Ended ended = run_program({"run", "freefall:cube:3", "--frames", "5", "--engine", engine});
    EXPECT_EQ(ended.exit_code, 2) << engine << ": " << ended.out << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    return ended.err;
  };
  const auto says = [&](const std::string& engine, const std::string& words) {
    const std::string line = refused(engine);
    EXPECT_NE(line.find(words), std::string::npos) << line;
  };
  says(wrong("prints-first"), "its answer begins with the bytes 'Hell");
  says(wrong("prints-first"), "write only the protocol to standard output");
  says(wrong("says-nothing"), "the program ended with exit code 7 instead of answering");
  says(wrong("hello-ends-early"), "ended with exit code 0 after 12 of ");
  says(wrong("hello-goes-on"), "its answer to hello is too long by 5 bytes");
  says(wrong("hello-has-no-end"), "ends in the middle of a value");
  says(wrong("hello-of-version-9"), "it speaks version 9 of the protocol");
  says(wrong("declares-unknown-word"), "'friction' cannot be declared as 'con'; did you mean 'cone'?");
  says("no-such-program-at-all x", "cannot start it: No such file or directory");
  says("python3 'half a quote", "a quote ' does not end");
}

TEST(ProgramRun, WhatGoesWrongInARunIsACellThatSaysSo) {
  const auto says = [](const std::string& fault, const std::string& words) {
    const Outcome o = outcome(fault);
    EXPECT_EQ(o.run.exit_code, 3) << fault << ": " << o.run.out << o.run.err;
    EXPECT_NE(o.cell.reason.find(words), std::string::npos) << fault << ": " << o.cell.reason;
    EXPECT_EQ(o.cell.reason.find('\n'), std::string::npos) << o.cell.reason;
  };
  says("step-raises", "wrong-program: step: RuntimeError: the moon is full");
  says("dies-at-step", "step: the program was ended by signal 9 (Killed) instead of answering");
  says("step-answers-half", "step: the program ended with exit code 0 after 1 of 4 bytes of its answer");
  says("step-answers-garbage", "step: its answer begins with the bytes 'step");
  says("step-says-an-hour", "says that the step took 3600");
  says("states-are-too-few", "read_states: it answers for 2 bodies, and the scene has 3");
  says("states-are-half", "read_states: its answer has ");
  says("states-claim-a-gigabyte", "read_states: its answer begins with the bytes");
  says("impulse-is-nan", "read_points: point number 0 has an impulse that is NaN or infinite");
  says("point-names-no-body", "point number 0 is between 77 and 4294967280, and there are 3 bodies");
}

TEST(ProgramRun, FramesBeforeAFaultAreKept) {
  const Outcome o = outcome("step-raises");
  EXPECT_EQ(o.cell.frames, 2U) << "two steps were whole";
}

TEST(ProgramRun, WhatIsPrintedByTheEnginesCodeDoesNotSpoilTheProtocol) {
  const Outcome o = outcome("step-prints");
  EXPECT_EQ(o.run.exit_code, 0) << o.run.out << o.run.err;
  EXPECT_NE(o.run.err.find("step 3"), std::string::npos) << o.run.err;
}

TEST(ProgramRun, AProgramThatNeverAnswersEndsAtTheTimeLimit) {
  const auto start = std::chrono::steady_clock::now();
  const Outcome o = outcome("never-answers-step", "3");
  EXPECT_EQ(o.run.exit_code, 3) << o.run.err;
  EXPECT_EQ(o.cell.state, core::CellState::kTimedOut) << o.run.out;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(120)) << "and so has the program itself";
}

TEST(ProgramRun, ItIsUnderTheLimitOfMemory) {
  const ScratchFolder folder;
  const Ended ended = run_program({"run", "freefall:cube:3", "--frames", "5", "--engine", wrong("step-takes-memory"),
                                   "--memory-limit", "1024", "--out", folder.text()});
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("MemoryError"), std::string::npos) << ended.out;
}

// Sets an environment variable for as long as this object lives, and then restores it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Variable() { before_.empty() ? unsetenv(name_) : setenv(name_, before_.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

// An interpreter takes long to start, so a program is asked for its description once in a tree of processes. The log
// has a line for each start: one for the description, one for the run in the child.
TEST(ProgramRun, WhatItIsIsAskedOnceForAllProcessesOfARun) {
  const ScratchFolder folder;
  const std::string log = folder.text() + "/starts";
  const Variable starts("BROADSIDE_TEST_STARTS", log.c_str());
  const Variable told("BROADSIDE_DESCRIBED", "no JSON");
  const Ended ended =
      run_program({"run", "freefall:cube:3", "--frames", "5", "--engine", wrong("none"), "--out", folder.text()});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  std::ifstream lines(log);
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(lines), {}, '\n'), 2);
}

Ended run_one_that_never_says_hello(const char* limit_s) {
  const Variable limit("BROADSIDE_HELLO_LIMIT_S", limit_s);
  return run_program({"run", "freefall:cube:3", "--frames", "5", "--engine", wrong("never-answers-hello")});
}

TEST(ProgramRun, AProgramThatNeverSaysHelloIsRefused) {
  const Ended ended = run_one_that_never_says_hello("1.5");
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("asking it to describe itself: no end after 1.5 s"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("more time: BROADSIDE_HELLO_LIMIT_S=60"), std::string::npos) << ended.err;
}

TEST(ProgramRun, ATimeForHelloThatIsNoneIsBadInput) {
  for (const char* limit_s : {"", "soon", "0", "-3", "10 s", "nan", "1e9"}) {
    const Ended ended = run_one_that_never_says_hello(limit_s);
    EXPECT_EQ(ended.exit_code, 2) << limit_s;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find("BROADSIDE_HELLO_LIMIT_S"), std::string::npos) << ended.err;
  }
}

TEST(ProgramRun, ItsOwnSecondsAreTheTimes) {
  const ScratchFolder folder;
  const auto stages = [&](const std::string& fault) {
    const std::filesystem::path out = folder / fault;
    std::filesystem::create_directories(out);
    const Ended ended = run_program({"time", "freefall:cube:3", "--frames", "5", "--repetitions", "1", "--engine",
                                     wrong(fault), "--out", (out / "samples.json").string()});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto rows = core::read_rows(out);
    if (!rows.ok() || rows.value().samples.size() != 1) return std::pair(ended.out, std::vector<core::StageSeries>());
    return std::pair(rows.value().samples[0].stamp.engine_build, rows.value().samples[0].stages);
  };
  const auto find = [](const std::vector<core::StageSeries>& all, const std::string& stage) {
    for (const core::StageSeries& series : all)
      if (series.stage == stage) return series.seconds;
    return std::vector<double>();
  };
  const auto [with_pipe, plain] = stages("none");
  EXPECT_NE(with_pipe.find("times include its pipe"), std::string::npos) << with_pipe;
  EXPECT_TRUE(find(plain, "pipe").empty());
  const auto [own_clock, told] = stages("tells-seconds");
  EXPECT_NE(own_clock.find("times by its own clock"), std::string::npos) << own_clock;
  EXPECT_EQ(find(told, "frame"), std::vector<double>(5, 1e-9));
  EXPECT_EQ(find(told, "pipe").size(), 5U);
}

TEST(ProgramRun, EnginesMayStandInAFile) {
  const ScratchFolder folder;
  std::ofstream(folder / "mine.txt") << "# two engines\n\n  " << wrong("none") << "  \noctree-cpu\n";
  const Ended ended = run_program({"run", "freefall:cube:3", "--frames", "5", "--engines",
                                   (folder / "mine.txt").string(), "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto rows = core::read_rows(folder / "out");
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows.value().cells.size(), 2U);
  for (const std::string& file : {std::string("no.txt"), std::string("empty.txt")}) {
    std::ofstream(folder / "empty.txt") << "# nothing\n";
    const Ended refused = run_program({"run", "freefall:cube:3", "--engines", (folder / file).string()});
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_TRUE(is_one_line(refused.err)) << refused.err;
  }
}

// The examples, each judged by every law: none fails, and the laws that are named here met something to check.
void expect_lawful(const std::string& engine, const std::string& scene, const std::string& trace) {
  const ScratchFolder folder;
  const Ended run = run_program({"run", kExamples + scene, "--engine", engine, "--out", folder.text()});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const Ended check = run_program({"check", (folder / trace).string()});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  for (const char* law : {"ballistic", "turning", "gyroscopic", "momentum", "angular-momentum", "friction-cone",
                          "unilateral", "contact-truth", "energy-growth", "box-contains"}) {
    const auto at = check.out.find("\n" + std::string(law) + " ");
    ASSERT_NE(at, std::string::npos) << law << check.out;
    EXPECT_NE(check.out.substr(at, 60).find(" pass"), std::string::npos) << check.out.substr(at, 200);
  }
}

bool is_here(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(Examples, TheLibraryThatTurnsKeepsEveryLaw) {
  const std::string library = std::string(BROADSIDE_PLUGIN_DIR) + "/libbouncing_body.so";
  expect_lawful(library, "spinning_box.toml", "example-bouncing-body.h5");
  expect_lawful(library, "rolling_ball.toml", "example-bouncing-body.h5");
}

TEST(Examples, TheProgramInJavaScriptKeepsEveryLaw) {
  if (!is_here("node --version")) GTEST_SKIP() << "no Node here (Debian: nodejs)";
  expect_lawful("node " + kExamples + "bouncing_body.mjs", "spinning_box.toml", "example-bouncing-node.h5");
  expect_lawful("node " + kExamples + "bouncing_body.mjs", "rolling_ball.toml", "example-bouncing-node.h5");
}

TEST(Examples, TheProgramInPythonKeepsEveryLaw) {
  expect_lawful("python3 -B " + kExamples + "bouncing_body.py", "spinning_box.toml", "example-bouncing-python.h5");
  expect_lawful("python3 -B " + kExamples + "bouncing_body.py", "rolling_ball.toml", "example-bouncing-python.h5");
}

TEST(Examples, TheProgramInRustKeepsEveryLaw) {
  if (!is_here("rustc --version")) GTEST_SKIP() << "no rustc here: the Rust client was not compiled and not run";
  const ScratchFolder folder;
  const std::string program = (folder / "bouncing_ball").string();
  ASSERT_TRUE(is_here("rustc -O --edition 2021 '" + kExamples + "bouncing_ball.rs' -o '" + program + "'"));
  expect_lawful(program, "rolling_ball.toml", "example-bouncing-rust.h5");
}

}  // namespace
}  // namespace broadside::tests
