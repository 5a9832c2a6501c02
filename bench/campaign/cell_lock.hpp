// A lock that keeps two processes, perhaps on two machines with one file system, from working on the same cell.
#pragma once

#include <filesystem>
#include <optional>

namespace broadside::bench::campaign {

class CellLock {
 public:
  // Empty when another process holds it, or when the folder cannot be written. The lock ends with the process that
  // holds it, also when that process is killed (flock; a network file system needs lock support, as Slurm's shared
  // folders have).
  static std::optional<CellLock> take(const std::filesystem::path& file);

  CellLock(CellLock&& other) noexcept;
  CellLock& operator=(CellLock&&) = delete;
  ~CellLock();

 private:
  explicit CellLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace broadside::bench::campaign
