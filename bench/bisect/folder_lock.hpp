// A lock on a bisection's folder: one bisection works there at a time, and the programs that a killed bisection started
// hold the lock until they have ended.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::bench::bisect {

class FolderLock {
 public:
  // Waits, and says so, while another bisection works there, or a build or command that a killed one started. Errors:
  // interrupted, or a folder that cannot be written.
  static core::Result<FolderLock> take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

  // The descriptor that started programs inherit: the lock lasts until every program that has it open has ended.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace broadside::bench::bisect
