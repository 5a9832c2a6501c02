// The command of a bisection, with the paths of a build filled in.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace broadside::bench::bisect {

// Where a build lies: {build}; the Broadside program in it: {program}.
struct BuildPlace {
  std::filesystem::path build;
  std::filesystem::path program;
};

// The text with {build}, {program} and {out} replaced by absolute paths, quoted for a shell.
std::string filled_in(const std::string& command, const BuildPlace& place, const std::filesystem::path& out);

// Quotes a text so that a shell takes it as one word.
std::string quoted(const std::string& text);

// Runs the text in a shell whose working folder is `folder`; its output goes to the log. Returns the exit code, which
// is 128 plus the signal's number where a signal ended the command. `lock`: the descriptor of the FolderLock, which the
// command inherits.
core::Result<int> run_in_shell(const std::string& text, const std::filesystem::path& folder,
                               const std::filesystem::path& log, int lock);

// What a log says about a failure, after ": ": the first line that a compiler calls an error, otherwise the last line.
// Empty where the log is empty.
std::string said_in(const std::filesystem::path& log);

}  // namespace broadside::bench::bisect
