// The subcommands. Each function adds a subcommand and its options to the program; the subcommand runs when it was
// chosen.
#pragma once

#include "core/result.hpp"

namespace CLI {
class App;
}

namespace broadside::bench {

using AddCommand = void (*)(CLI::App& program, core::Exit& exit);

void add_list(CLI::App& program, core::Exit& exit);
void add_run(CLI::App& program, core::Exit& exit);
void add_agree(CLI::App& program, core::Exit& exit);
void add_pairs(CLI::App& program, core::Exit& exit);
void add_candidates(CLI::App& program, core::Exit& exit);
void add_compare(CLI::App& program, core::Exit& exit);
void add_bisect(CLI::App& program, core::Exit& exit);
void add_mutants(CLI::App& program, core::Exit& exit);
void add_check(CLI::App& program, core::Exit& exit);
void add_converge(CLI::App& program, core::Exit& exit);
void add_time(CLI::App& program, core::Exit& exit);
void add_history(CLI::App& program, core::Exit& exit);
void add_report(CLI::App& program, core::Exit& exit);
void add_demo(CLI::App& program, core::Exit& exit);
void add_fetch(CLI::App& program, core::Exit& exit);
void add_fetch_engine(CLI::App& program, core::Exit& exit);
void add_mesh(CLI::App& program, core::Exit& exit);
void add_scene(CLI::App& program, core::Exit& exit);
void add_export(CLI::App& program, core::Exit& exit);
void add_recover(CLI::App& program, core::Exit& exit);
void add_plan(CLI::App& program, core::Exit& exit);
void add_merge(CLI::App& program, core::Exit& exit);
void add_describe_plugin(CLI::App& program, core::Exit& exit);
void add_diff(CLI::App& program, core::Exit& exit);
void add_replay(CLI::App& program, core::Exit& exit);
void add_paper(CLI::App& program, core::Exit& exit);
void add_contest(CLI::App& program, core::Exit& exit);
void add_shrink(CLI::App& program, core::Exit& exit);
void add_view(CLI::App& program, core::Exit& exit);

// Prints the error's one line to stderr and returns its exit code.
core::Exit complain(const core::Error& error);

}  // namespace broadside::bench
