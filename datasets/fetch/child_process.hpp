// Runs another program without a shell, and says in one line why it failed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

struct Command {
  std::vector<std::string> words;     // program (looked up in PATH) and its arguments, passed as they are
  std::filesystem::path folder;       // working folder; messages are kept there during the run
  std::filesystem::path output_file;  // its standard output; empty = dropped
};

// Waits for the program to end. Errors, with Exit::kMissing: the program is not installed; it failed (exit status and
// last line of its messages); a signal ended it.
core::Status run_command(const Command& command);

}  // namespace broadside::datasets
