#include "core/trace/page_journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "core/pair.hpp"
#include "core/trace/part_file.hpp"

namespace broadside::core {
namespace {

struct Trailer {
  std::uint64_t magic = 0;
  std::uint64_t base = 0;
  std::uint64_t end = 0;
  std::uint64_t count = 0;
  std::uint64_t checksum = 0;  // of indices, pages and the words above
};
constexpr std::uint64_t kMagic = 0x6c6e726a65646973ULL;  // "sidejrnl", little-endian
constexpr std::size_t kEntryBytes = sizeof(std::uint64_t) + kPageBytes;

std::uint64_t checksum_of(std::span<const std::byte> body, const Trailer& t) {
  std::uint64_t h = splitmix64(t.magic ^ splitmix64(t.base ^ splitmix64(t.end ^ splitmix64(t.count))));
  for (std::size_t at = 0; at < body.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, body.data() + at, sizeof word);
    h = splitmix64(h ^ word);
  }
  return h;
}

bool read_fully(int fd, std::uint64_t address, std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = pread(fd, data, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    address += static_cast<std::uint64_t>(n);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

struct Journal {
  std::uint64_t end = 0;
  Pages pages;
};

std::optional<Journal> read_journal(int fd) {
  struct stat facts {};
  if (fstat(fd, &facts) != 0) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  Trailer t;
  if (size < sizeof t || !read_fully(fd, size - sizeof t, reinterpret_cast<std::byte*>(&t), sizeof t))
    return std::nullopt;
  const std::uint64_t room = size - sizeof t;
  if (t.magic != kMagic || t.base > room || (room - t.base) / kEntryBytes != t.count ||
      (room - t.base) % kEntryBytes != 0 || t.end > t.base)
    return std::nullopt;
  std::vector<std::byte> body(room - t.base);
  if (!read_fully(fd, t.base, body.data(), body.size()) || checksum_of(body, t) != t.checksum) return std::nullopt;
  Journal journal{t.end, {}};
  for (std::uint64_t k = 0; k < t.count; ++k) {
    std::uint64_t index = 0;
    std::memcpy(&index, body.data() + k * sizeof index, sizeof index);
    if (index >= t.base / kPageBytes + 1) return std::nullopt;
    std::memcpy(journal.pages[index].data(), body.data() + t.count * sizeof index + k * kPageBytes, kPageBytes);
  }
  return journal;
}

}  // namespace

int write_fully(int fd, std::uint64_t address, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = pwrite(fd, data, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n < 0 ? errno : ENOSPC;
    address += static_cast<std::uint64_t>(n);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return 0;
}

int append_journal(int fd, std::uint64_t base, std::uint64_t end, const Pages& pages) {
  std::vector<std::byte> body(pages.size() * kEntryBytes);
  std::byte* indices = body.data();
  std::byte* contents = body.data() + pages.size() * sizeof(std::uint64_t);
  for (const auto& [index, page] : pages) {
    std::memcpy(indices, &index, sizeof index);
    std::memcpy(contents, page.data(), kPageBytes);
    indices += sizeof index;
    contents += kPageBytes;
  }
  Trailer t{kMagic, base, end, pages.size(), 0};
  t.checksum = checksum_of(body, t);
  if (const int code = write_fully(fd, base, body.data(), body.size()); code != 0) return code;
  return write_fully(fd, base + body.size(), reinterpret_cast<const std::byte*>(&t), sizeof t);
}

int put_in_place(int fd, std::uint64_t end, const Pages& pages) {
  for (const auto& [index, page] : pages) {
    const std::uint64_t address = index * kPageBytes;
    if (address >= end) continue;
    const std::size_t size = std::min<std::uint64_t>(kPageBytes, end - address);
    if (const int code = write_fully(fd, address, page.data(), size); code != 0) return code;
  }
  return ftruncate(fd, static_cast<off_t>(end)) == 0 ? 0 : errno;
}

Status finish_from_journal(const std::filesystem::path& path) {
  using std::chrono::milliseconds;
  constexpr int kTries = 500;
  for (int k = 0; k < kTries; ++k) {
    const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return Done{};  // the next read reports the reason
    const std::optional<Journal> journal = read_journal(fd);
    close(fd);
    if (!journal) return Done{};
    if (is_being_written(path)) {
      std::this_thread::sleep_for(milliseconds(2));
      continue;
    }
    // Two processes may complete the same journal at once: they write the same bytes.
    const int writable = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (writable < 0) return disk_error(errno, path, "finishing its last flush, which was cut off,");
    const int code = put_in_place(writable, journal->end, journal->pages);
    close(writable);
    if (code != 0) return disk_error(code, path, "finishing its last flush, which was cut off,");
    return Done{};
  }
  return Done{};
}

}  // namespace broadside::core
