// Runs this program again as a child process, so that a library that aborts, hangs or uses up the machine's memory
// cannot take the harness down.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/cell/cell_request.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"
#include "core/sample.hpp"

namespace broadside::bench {

struct ChildLimits {
  double seconds = 3600.0;
  std::uint64_t memory_mib = 0;  // of address space beyond what the child has when it begins its work; 0 = no limit
  bool are_asked = false;        // by the user; then our own engines run in a child too, so that the limits apply
};

// Adds "--memory-limit N" where there is a limit. The child sets it on itself (`limit_this_process`) after its
// libraries are loaded and before it loads a scene. The command that repeats a cell contains it too.
void append_memory_limit(std::vector<std::string>& arguments, const ChildLimits& limits);

struct ChildEnding {
  bool is_good = false;  // ended by itself with exit code 0
  int exit_code = -1;    // -1 when a signal or the time limit ended it
  int signal = 0;        // the signal that ended it; 0 when none did
  bool timed_out = false;
  bool is_interrupted = false;  // this program was asked to end before the child ended well
  std::string
      words;  // "signal 6 (Aborted): ...", "no end after 10 s", "interrupted", "exit code 2: ..."; empty when good
  std::string last_line;  // of its stderr: an assert's message, or our own one clear line
  std::string output;     // its stdout, where kept
};

// How the child ended, in the words of `agree`: "abort", "crash", "time-out", "interrupted", "out of memory",
// "exception"; empty when it ended well.
std::string_view class_of(const ChildEnding& ending);

// As typed in a shell: arguments with spaces or brackets are quoted.
std::string command_line(const std::vector<std::string>& arguments);

// Which of a child's streams are kept here instead of passed on. Of stderr only the last line is kept.
enum class Keeps { kNothing, kOutput, kOutputAndErrors };

// Runs `broadside ARGUMENTS...`. Ctrl-C is passed on to the child; a child that goes on for 0.8 s more is killed, and
// what it prints after the interrupt is not shown. When the parent is killed, the child ends too.
core::Result<ChildEnding> run_self(const std::vector<std::string>& arguments, const ChildLimits& limits, Keeps keeps);

// `broadside run ... --in-process`. A signal, a time-out or an unexplained exit becomes a cell that says so, with the
// command that repeats it; bad input of the child comes back as its error.
core::Result<core::Cell> record_cell_in_child(const CellRequest& request, const ChildLimits& limits);

// `broadside time ... --in-process`: warm-up and one repetition. An ending that is not good is an error with its text.
core::Result<core::Sample> time_cell_in_child(const CellRequest& request, const ChildLimits& limits);

}  // namespace broadside::bench
