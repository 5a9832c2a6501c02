// Another program, run to its end.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

// Runs the program and returns its exit code. stdin is empty; stdout and stderr go to the log file, or nowhere with an
// empty name. A name without a slash is searched for in PATH. An error when it cannot be started or was ended by a
// signal, with the log's last line. The program inherits the descriptor `inherited` under its number, unless it is -1.
core::Result<int> run_program(const std::string& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& log, int inherited = -1);

// A program that was started and not yet waited for.
class RunningProgram {
 public:
  // Arguments as for run_program.
  static core::Result<RunningProgram> start(const std::string& program, const std::vector<std::string>& arguments,
                                            const std::filesystem::path& log, int inherited = -1);
  // Result as of run_program. Call it once.
  core::Result<int> wait();

 private:
  RunningProgram(pid_t process, std::string program, std::filesystem::path log);

  pid_t process_;
  std::string program_;
  std::filesystem::path log_;
};

// The last line of a log that is not empty.
std::string last_line(const std::filesystem::path& log);

}  // namespace broadside::bench
