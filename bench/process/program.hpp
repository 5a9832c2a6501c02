// Another program, run to its end.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

// Its exit code. stdin is empty; stdout and stderr go to the log file, or nowhere with an empty name. A name without a
// slash is searched for in PATH. An error when it cannot be started or was ended by a signal; the log's last line is in
// it. The descriptor `inherited` is there in the program too, under its number, unless it is -1.
core::Result<int> run_program(const std::string& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& log, int inherited = -1);

// A program that was started and not yet waited for.
class RunningProgram {
 public:
  // As run_program.
  static core::Result<RunningProgram> start(const std::string& program, const std::vector<std::string>& arguments,
                                            const std::filesystem::path& log, int inherited = -1);
  // As run_program, once.
  core::Result<int> wait();

 private:
  RunningProgram(pid_t process, std::string program, std::filesystem::path log);

  pid_t process_;
  std::string program_;
  std::filesystem::path log_;
};

// The last line of a log that says something.
std::string last_line(const std::filesystem::path& log);

}  // namespace broadside::bench
