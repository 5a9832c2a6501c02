#include "bench/bisect/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/record/run_plan.hpp"

namespace broadside::bench::bisect {

core::Result<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  if (core::Status s = prepare_folder(folder); !s) return s.error();
  const std::filesystem::path file = folder / "lock";
  const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor < 0)
    return core::Error{"cannot be written: " + std::generic_category().message(errno), file.string(),
                       "choose another --out"};
  FolderLock lock(descriptor);
  bool is_told = false;
  while (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR)
      return core::Error{"cannot be locked: " + std::generic_category().message(errno), file.string(),
                         "choose another --out, on a file system of this machine"};
    if (is_interrupted()) return core::Error{"interrupted", "bisect", "", core::Exit::kMissing};
    if (!is_told)
      fmt::print(stderr, "bisect: waiting for another bisect in {}, or for a process that a killed one left running\n",
                 folder.string());
    is_told = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return lock;
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

// The file is not removed: otherwise a third bisection could lock a new file while a second still holds the old one.
FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace broadside::bench::bisect
