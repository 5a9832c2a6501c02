// What a bisection has observed so far, in one file, from which a killed bisection goes on.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/result.hpp"

namespace broadside::bench::bisect {

// How the command ended on one build. Its results lie in the folder of the build.
struct Seen {
  bool is_judged = false;
  int exit_code = 0;
  std::string reason;  // why it was skipped; empty when judged
};

struct State {
  std::string question;               // what is asked about which builds; another question needs another folder
  std::map<std::string, Seen> seen;   // by folder name of the build; "control" is the good build again
  std::map<std::string, Seen> timed;  // builds whose times were compared with the good one's
};

// The state in the folder; an empty one when there is none. An error when the folder holds the answer to another
// question, or a file that is damaged.
core::Result<State> read_state(const std::filesystem::path& folder, const std::string& question);

// Replaces the file in one piece: a crash leaves the old state or the new one.
core::Status write_state(const std::filesystem::path& folder, const State& state);

}  // namespace broadside::bench::bisect
