#include "bench/process/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace broadside::bench {

std::string last_line(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

core::Result<int> run_program(const std::string& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& log, int inherited) {
  auto running = RunningProgram::start(program, arguments, log, inherited);
  if (!running) return running.error();
  return running.value().wait();
}

RunningProgram::RunningProgram(pid_t process, std::string program, std::filesystem::path log)
    : process_(process), program_(std::move(program)), log_(std::move(log)) {}

core::Result<RunningProgram> RunningProgram::start(const std::string& program,
                                                   const std::vector<std::string>& arguments,
                                                   const std::filesystem::path& log, int inherited) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);

  const std::string output = log.empty() ? "/dev/null" : log.string();
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  // dup2 of a descriptor onto itself clears its close-on-exec flag, in the new process alone.
  if (inherited >= 0) posix_spawn_file_actions_adddup2(&files, inherited, inherited);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0)
    return core::Error{"cannot be started: " + std::generic_category().message(failed), program,
                       "name a program that runs here"};
  return RunningProgram(child, program, log);
}

core::Result<int> RunningProgram::wait() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  return core::Error{
      "was ended by signal " + std::to_string(WTERMSIG(status)) + (log_.empty() ? "" : ": " + last_line(log_)),
      program_, "", core::Exit::kMissing};
}

}  // namespace broadside::bench
