// The limits of child processes as options of a command, worded alike everywhere.
#pragma once

#include "bench/process/child.hpp"

namespace CLI {
class App;
}

namespace broadside::bench {

// --time-limit and --memory-limit; what `limits` holds is the default.
void add_limits(CLI::App& command, ChildLimits& limits);

}  // namespace broadside::bench
