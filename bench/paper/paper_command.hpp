// The subcommand `paper`. Its declaration is not in bench/cli/commands.hpp, so that the other subcommands do not depend
// on it.
#pragma once

#include "core/result.hpp"

namespace CLI {
class App;
}

namespace broadside::bench {

void add_paper(CLI::App& program, core::Exit& exit);

}  // namespace broadside::bench
