#include "bench/cli/limit_arguments.hpp"

#include <CLI/CLI.hpp>

#include "bench/cell/more_than_zero.hpp"

namespace broadside::bench {

void add_limits(CLI::App& command, ChildLimits& limits) {
  command.add_option("--time-limit", limits.seconds, "Seconds after which a reference engine's process is ended")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command
      .add_option("--memory-limit", limits.memory_mib,
                  "MiB of memory that a reference engine's process may take; 0 = no limit")
      ->capture_default_str();
}

}  // namespace broadside::bench
