// Changed pages of a file, written behind its end before they are written in place: a process that is killed in between
// leaves either the old pages or the means to finish. Private to core/trace/*.cpp.
//
// A write system call that crosses a page can be cut there by SIGKILL, and HDF5's structures carry checksums: half of
// one makes a file unreadable. Layout behind the end: indices [n] u64, pages [n] of 4096 bytes, then the trailer.
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

// Writes all of it at an address; 0 or an errno.
int write_fully(int fd, std::uint64_t address, const std::byte* data, std::size_t size);

// From `base` on, which lies behind everything that old and new content need. end: the file's size once the pages are
// in place. 0 or an errno.
int append_journal(int fd, std::uint64_t base, std::uint64_t end, const Pages& pages);

// Puts the pages in place and cuts the journal off; 0 or an errno.
int put_in_place(int fd, std::uint64_t end, const Pages& pages);

// Finishes what the journal at the end of a file describes; without a whole one nothing is done. While a writer holds
// the file, waits for it to get through. Errors: no permission to write, or the disk refuses.
Status finish_from_journal(const std::filesystem::path& path);

}  // namespace broadside::core
