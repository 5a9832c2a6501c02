// Another program, run to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

// Its exit code. stdin is empty; stdout and stderr go to the log file, or nowhere with an empty name. A name without a
// slash is searched for in PATH. An error when it cannot be started or was ended by a signal; the log's last line is in
// it.
core::Result<int> run_program(const std::string& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& log);

// The last line of a log that says something.
std::string last_line(const std::filesystem::path& log);

}  // namespace broadside::bench
