// The program: subcommands and their exit codes.
#include "bench/cli/command_line.hpp"

int main(int argc, char** argv) {
  return broadside::bench::run_command_line(argc, argv);
}
