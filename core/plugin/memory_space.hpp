// Where a plug-in needs its arrays: on the host or on the device. The adapter knows only this interface.
#pragma once

#include <cstddef>
#include <memory>

#include "core/result.hpp"

namespace broadside::core {

// A block of bytes. Where the memory space supports it, memory after the block's end cannot be written.
class MemoryBlock {
 public:
  virtual ~MemoryBlock() = default;

  // The address that is given to the plug-in.
  [[nodiscard]] virtual void* data() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  virtual Status upload(const void* from, std::size_t bytes) = 0;
  virtual Status download(void* to, std::size_t bytes) const = 0;
  // Inputs are locked while a plug-in runs: a write into one ends its process.
  virtual void lock() = 0;
  virtual void unlock() = 0;
};

class MemorySpace {
 public:
  virtual ~MemorySpace() = default;

  // Allocates at least one byte. Error: out of memory, with the amount.
  virtual Result<std::unique_ptr<MemoryBlock>> allocate(std::size_t bytes) = 0;
};

// Each block has pages of its own between two guard pages that cannot be accessed, and it ends where the second guard
// page begins.
std::unique_ptr<MemorySpace> make_host_space();

}  // namespace broadside::core
