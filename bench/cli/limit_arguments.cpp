#include "bench/cli/limit_arguments.hpp"

#include <CLI/CLI.hpp>
#include <string>

#include "bench/cell/more_than_zero.hpp"

namespace broadside::bench {

void add_limits(CLI::App& command, ChildLimits& limits) {
  command.add_option("--time-limit", limits.seconds, "Seconds after which an engine's process is ended")
      ->each([&limits](const std::string&) { limits.are_asked = true; })
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command
      .add_option("--memory-limit", limits.memory_mib, "MiB of memory that an engine's process may take; 0 = no limit")
      ->each([&limits](const std::string&) { limits.are_asked = true; })
      ->capture_default_str();
}

}  // namespace broadside::bench
