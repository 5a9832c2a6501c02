// Which program this is and which machine it runs on: the part of a stamp that follows neither from the scene nor from
// the engine.
#pragma once

#include <string>

namespace broadside::bench {

// Version, commit, compiler, flags, and the linker's build id: a hash of the program itself, so that two builds from
// one edited tree are told apart.
std::string build_line();

// CPU model, threads, memory, system, and the GPU or "no device".
std::string machine_line();

}  // namespace broadside::bench
