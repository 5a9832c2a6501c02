// The command line: one table of subcommands.
#pragma once

namespace broadside::bench {

// Returns the exit code of DESIGN: 0 good; 1 a validator failed; 2 bad usage or input; 3 inconclusive or missing;
// 4 internal.
int run_command_line(int argc, char** argv);

}  // namespace broadside::bench
