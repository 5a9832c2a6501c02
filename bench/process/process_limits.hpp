// What a child process may take before it is ended instead of the machine.
#pragma once

#include <cstdint>

namespace broadside::bench {

// Address space of this process: memory_mib (MiB) beyond what it has now, 0 = no limit; allocations fail beyond it.
// Said by the process itself after exec: what its parent has in use says nothing about what it will have. Leaves no
// core file either. Async-signal-safe.
void limit_this_process(std::uint64_t memory_mib);

// No core files: a library that aborts twenty thousand times would fill the disk. Async-signal-safe, for use between
// fork and exec.
void leave_no_core_file();

// In a child that was just forked by `parent`: it dies when its parent does, also when that came before.
// Async-signal-safe.
void die_with(int parent);

}  // namespace broadside::bench
