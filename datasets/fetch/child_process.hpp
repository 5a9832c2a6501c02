// Runs another program without a shell, and says in one line why it failed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

struct Command {
  std::vector<std::string> words;     // program (looked up in PATH) and its arguments, passed as they are
  std::filesystem::path folder;       // it runs there, and its messages are kept there while it does
  std::filesystem::path output_file;  // its standard output; empty = dropped
};

// Waits for the end. Errors, with Exit::kMissing: the program is not installed; it failed (exit status, last line of
// its messages); it was ended by a signal.
core::Status run_command(const Command& command);

}  // namespace broadside::datasets
