// Ctrl-C and SIGTERM end work that takes minutes: soon, with one line and exit code 3. The work cannot check for the
// signal, because it is one call of an engine. Earlier, such work went on to its end.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

using Clock = std::chrono::steady_clock;

struct Case {
  std::string name;
  std::string engine;
  std::string boxes;
  int signal;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class Interrupt : public testing::TestWithParam<Case> {};

// Whether it handles the signal by now, from the mask of caught signals that the kernel shows.
bool handles(pid_t process, int signal) {
  const std::string status = read_text("/proc/" + std::to_string(process) + "/status");
  const std::size_t at = status.find("SigCgt:");
  if (at == std::string::npos) return false;
  return (std::stoull(status.substr(at + 7, 17), nullptr, 16) >> (signal - 1) & 1U) != 0;
}

TEST_P(Interrupt, EndsAnEngineInTheMiddleOfACall) {
  const ScratchFolder folder;
  const pid_t child = start_program(folder, {"pairs", GetParam().boxes, "--engine", GetParam().engine});
  for (int k = 0; k < 600 && !handles(child, GetParam().signal); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  kill(child, GetParam().signal);
  const auto start = Clock::now();
  const Ended ended = wait_for(folder, child);
  // 0.6 s, and what a busy machine adds to it.
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 10.0);
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "") << "an interrupt is no engine's crash";
}

// Four million million tests in this process, and an insertion that takes more than five minutes in a child process.
INSTANTIATE_TEST_SUITE_P(All, Interrupt,
                         testing::Values(Case{"CtrlCHere", "all-pairs", "boxes:uniform:3000000", SIGINT},
                                         Case{"TermHere", "all-pairs", "boxes:uniform:3000000", SIGTERM},
                                         Case{"CtrlCInAChild", "bullet-sap", "boxes:uniform:200000", SIGINT},
                                         Case{"TermInAChild", "bullet-sap", "boxes:uniform:200000", SIGTERM}),
                         [](const auto& instance) { return instance.param.name; });

// Earlier, the limit was applied only to vendors' engines.
TEST(Limits, BindOurOwnEnginesToo) {
  const Ended memory =
      run_program({"pairs", "boxes:uniform:3000000", "--engine", "octree-cpu", "--memory-limit", "100"});
  EXPECT_EQ(memory.exit_code, 3) << memory.out << memory.err;
  EXPECT_NE(memory.out.find("out of memory"), std::string::npos) << memory.out << memory.err;
  const Ended time = run_program({"pairs", "boxes:uniform:3000000", "--engine", "all-pairs", "--time-limit", "1"});
  EXPECT_EQ(time.exit_code, 3) << time.out << time.err;
  EXPECT_NE(time.out.find("no end after 1 s"), std::string::npos) << time.out << time.err;
  const ScratchFolder folder;
  const Ended run = run_program({"run", "randommove:sphere:100", "--frames", "4000000", "--engine", "octree-cpu",
                                 "--time-limit", "2", "--out", folder.text()});
  EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
  EXPECT_NE(run.out.find("no end after 2 s"), std::string::npos) << run.out << run.err;
}

// Earlier, a child's error line was passed on and then printed again by the parent.
TEST(Limits, AnErrorOfAChildIsSaidOnce) {
  const ScratchFolder folder;
  std::ofstream(folder / "short.boxes") << "x";
  const Ended ended = run_program({"pairs", (folder / "short.boxes").string(), "--engine", "fcl-tree"});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
}

}  // namespace
}  // namespace broadside::tests
