#include "bench/campaign/cell_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <utility>

namespace broadside::bench::campaign {

std::optional<CellLock> CellLock::take(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor < 0) return std::nullopt;
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor);
    return std::nullopt;
  }
  return CellLock(descriptor);
}

CellLock::CellLock(CellLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

// The file is not removed: otherwise a third process could lock a new file while a second still holds the old one.
CellLock::~CellLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace broadside::bench::campaign
