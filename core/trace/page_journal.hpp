// Changed pages of a file, written after its end before they are written in place: a process that is killed in between
// leaves either the old pages or a complete journal. Private to core/trace/*.cpp.
//
// SIGKILL can cut a write system call at a page boundary, and HDF5's structures carry checksums: half of a structure
// makes a file unreadable. Layout after the end of the file: indices [n] u64, pages [n] of 4096 bytes, then the
// trailer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>

#include "core/result.hpp"

namespace broadside::core {

constexpr std::size_t kPageBytes = 4096;
using Page = std::array<std::byte, kPageBytes>;
using Pages = std::map<std::uint64_t, Page>;  // by address / kPageBytes

// Writes all bytes at an address. Returns 0 or an errno.
int write_fully(int fd, std::uint64_t address, const std::byte* data, std::size_t size);

// Writes the journal from `base` on, which must be past everything that the old and the new content need. end: the
// file's size once the pages are in place. Returns 0 or an errno.
int append_journal(int fd, std::uint64_t base, std::uint64_t end, const Pages& pages);

// Writes the pages in place and truncates the journal. Returns 0 or an errno.
int put_in_place(int fd, std::uint64_t end, const Pages& pages);

// Completes the journal at the end of a file; without a complete one it does nothing. While a writer holds the file,
// waits for that writer to complete it. Errors: no permission to write, or the disk refuses.
Status finish_from_journal(const std::filesystem::path& path);

}  // namespace broadside::core
