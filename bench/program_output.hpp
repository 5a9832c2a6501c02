// This program again, in a child process, for what it prints.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

struct ProgramOutput {
  int exit_code = 0;  // of a child that ended by itself
  std::string out;    // its standard output
  std::string err;    // its standard error
};

// Errors: it could not be started, died of a signal (named), or ran longer than the limit.
core::Result<ProgramOutput> run_this_program(const std::vector<std::string>& arguments, double time_limit_s);

}  // namespace broadside::bench
