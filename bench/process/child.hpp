// This program again, in a process of its own: a library that aborts, hangs or eats the machine's memory must not take
// the harness down.
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
};

// "--memory-limit N" where there is a limit: a child sets it on itself (`limit_this_process`) when its libraries are
// loaded and before it loads a scene, and the line that repeats a cell repeats its limit too.
void append_memory_limit(std::vector<std::string>& arguments, const ChildLimits& limits);

struct ChildEnding {
  bool is_good = false;  // ended by itself with exit code 0
  int exit_code = -1;    // -1 when a signal or the time limit ended it
  int signal = 0;        // that ended it; 0 when none did
  bool timed_out = false;
  std::string words;      // "signal 6 (Aborted): ...", "no end after 10 s", "exit code 2: ..."; empty when good
  std::string last_line;  // of its stderr: an assert's message, or our own one clear line
  std::string output;     // its stdout, where kept
};

// The verdict on an ending, in the words of `agree`: "abort", "crash", "time-out", "out of memory", "exception"; empty
// when it is good.
std::string_view class_of(const ChildEnding& ending);

// As somebody types it: arguments with spaces or brackets are quoted.
std::string command_line(const std::vector<std::string>& arguments);

// What of a child's streams is kept here instead of passed on. Of stderr that is the last line.
enum class Keeps { kNothing, kOutput, kOutputAndErrors };

// Runs `broadside ARGUMENTS...`. Ctrl-C is passed on. A parent that is killed takes its child along.
core::Result<ChildEnding> run_self(const std::vector<std::string>& arguments, const ChildLimits& limits, Keeps keeps);

// `broadside run ... --in-process`. Signal, time-out and an unexplained exit become cells that say so, with the command
// that repeats them; bad input of the child comes back as its error.
core::Result<core::Cell> record_cell_in_child(const CellRequest& request, const ChildLimits& limits);

// `broadside time ... --in-process`: warm-up and one repetition. An ending that is not good is an error in those words.
core::Result<core::Sample> time_cell_in_child(const CellRequest& request, const ChildLimits& limits);

}  // namespace broadside::bench
