#include "bench/program_output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Reads until both ends are closed or the time is up; false = time is up.
bool read_both(std::array<int, 2> ends, std::array<std::string*, 2> texts, Clock::time_point deadline) {
  std::array<char, 4096> buffer{};
  std::array<bool, 2> open{true, true};
  while (open[0] || open[1]) {
    if (Clock::now() > deadline) return false;
    std::array<pollfd, 2> waiting{pollfd{open[0] ? ends[0] : -1, POLLIN, 0}, pollfd{open[1] ? ends[1] : -1, POLLIN, 0}};
    if (poll(waiting.data(), waiting.size(), 100) <= 0) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      if (waiting[k].revents == 0) continue;
      const ssize_t got = read(ends[k], buffer.data(), buffer.size());
      if (got > 0) texts[k]->append(buffer.data(), static_cast<std::size_t>(got));
      if (got == 0 || (got < 0 && errno != EINTR)) open[k] = false;
    }
  }
  return true;
}

}  // namespace

core::Result<ProgramOutput> run_this_program(const std::vector<std::string>& arguments, double time_limit_s) {
  const std::string where = "starting a child process";
  std::array<int, 2> out{};
  std::array<int, 2> err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0)
    return core::Error{std::string("no pipe: ") + std::strerror(errno), where, "", core::Exit::kInternal};
  if (pipe2(err.data(), O_CLOEXEC) != 0) {
    const std::string why = std::strerror(errno);
    close(out[0]);
    close(out[1]);
    return core::Error{"no pipe: " + why, where, "", core::Exit::kInternal};
  }
  std::vector<char*> argv{const_cast<char*>("broadside")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    // Only async-signal-safe calls here: other threads of the parent may hold locks. A parent that is killed takes its
    // child along, so that nobody goes on writing where a later try begins.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  const std::string fork_failed = child < 0 ? std::strerror(errno) : "";
  close(out[1]);
  close(err[1]);
  ProgramOutput output;
  bool in_time = true;
  if (child > 0) {
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_limit_s));
    in_time = read_both({out[0], err[0]}, {&output.out, &output.err}, deadline);
    if (!in_time) kill(child, SIGKILL);
  }
  close(out[0]);
  close(err[0]);
  if (child < 0) return core::Error{"no process: " + fork_failed, where, "", core::Exit::kInternal};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time)
    return core::Error{"no answer within " + std::to_string(static_cast<int>(time_limit_s)) + " s", where, "",
                       core::Exit::kMissing};
  if (WIFSIGNALED(status))
    return core::Error{std::string("it died: ") + strsignal(WTERMSIG(status)), where, "", core::Exit::kMissing};
  output.exit_code = WEXITSTATUS(status);
  return output;
}

}  // namespace broadside::bench
