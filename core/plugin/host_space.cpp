#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/plugin/memory_space.hpp"

namespace broadside::core {
namespace {

std::size_t page_bytes() {
  static const auto kBytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return kBytes;
}

class GuardedBlock final : public MemoryBlock {
 public:
  GuardedBlock(char* pages, std::size_t page_count, std::size_t bytes)
      : pages_(pages), page_count_(page_count), bytes_(bytes) {}
  GuardedBlock(const GuardedBlock&) = delete;
  GuardedBlock& operator=(const GuardedBlock&) = delete;
  ~GuardedBlock() override { munmap(pages_, (page_count_ + 2) * page_bytes()); }

  [[nodiscard]] void* data() const override { return inside() + page_count_ * page_bytes() - bytes_; }
  [[nodiscard]] std::size_t bytes() const override { return bytes_; }

  Status upload(const void* from, std::size_t bytes) override {
    if (bytes > 0) std::memcpy(data(), from, bytes);
    return Done{};
  }
  Status download(void* to, std::size_t bytes) const override {
    if (bytes > 0) std::memcpy(to, data(), bytes);
    return Done{};
  }
  void lock() override { mprotect(inside(), page_count_ * page_bytes(), PROT_READ); }
  void unlock() override { mprotect(inside(), page_count_ * page_bytes(), PROT_READ | PROT_WRITE); }

 private:
  [[nodiscard]] char* inside() const { return pages_ + page_bytes(); }

  char* pages_;
  std::size_t page_count_;  // without the two guard pages
  std::size_t bytes_;
};

class HostSpace final : public MemorySpace {
 public:
  Result<std::unique_ptr<MemoryBlock>> allocate(std::size_t wanted) override {
    // Multiples of 8, so that when the end is at a page's edge, the start is aligned for a double.
    const std::size_t bytes = (std::max<std::size_t>(wanted, 1) + 7) / 8 * 8;
    const std::size_t page_count = (bytes + page_bytes() - 1) / page_bytes();
    const std::size_t all = (page_count + 2) * page_bytes();
    void* pages = mmap(nullptr, all, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (pages == MAP_FAILED)
      return Error{"out of memory: " + std::to_string(bytes) + " bytes for the plug-in's arrays", "plug-in",
                   "run a smaller scene", Exit::kMissing};
    auto block = std::make_unique<GuardedBlock>(static_cast<char*>(pages), page_count, bytes);
    block->unlock();
    return std::unique_ptr<MemoryBlock>(std::move(block));
  }
};

}  // namespace

std::unique_ptr<MemorySpace> make_host_space() {
  return std::make_unique<HostSpace>();
}

}  // namespace broadside::core
