// The command of a bisection, with the build that it is run on filled in.
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

// A word that a shell takes as it is.
std::string quoted(const std::string& text);

// Runs text in a shell with a folder as its working folder; its output goes to the log. Returns the exit code, which is
// 128 and the signal's number where a signal ended the command. `lock`: of the FolderLock, which the command keeps.
core::Result<int> run_in_shell(const std::string& text, const std::filesystem::path& folder,
                               const std::filesystem::path& log, int lock);

// What a log says of a failure, after ": " - the first line that a compiler calls an error, otherwise the last line.
// Empty where the log is.
std::string said_in(const std::filesystem::path& log);

}  // namespace broadside::bench::bisect
