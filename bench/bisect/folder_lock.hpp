// The folder of a bisection belongs to one at a time, and to what a killed one started until that has ended.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::bench::bisect {

class FolderLock {
 public:
  // Waits, and says so, while another bisection or the build or command of one that was killed works there. Error:
  // interrupted, or a folder that cannot be written.
  static core::Result<FolderLock> take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

  // For the programs that are started: the lock lasts until each that has it open has ended.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace broadside::bench::bisect
