// Limits on a child process, so that it fails before the machine runs out of memory.
#pragma once

#include <cstdint>

namespace broadside::bench {

// Limits the address space of this process to memory_mib (MiB) beyond what it has now, 0 = no limit; allocations beyond
// that fail. The process calls it on itself after exec, because its parent's use of memory says nothing about its own.
// Also turns core files off. Async-signal-safe.
void limit_this_process(std::uint64_t memory_mib);

// No core files: a library that aborts twenty thousand times would fill the disk. Async-signal-safe, for use between
// fork and exec.
void leave_no_core_file();

// For a child just forked by `parent`: it dies when its parent dies, also when the parent died before this call.
// Async-signal-safe.
void die_with(int parent);

}  // namespace broadside::bench
