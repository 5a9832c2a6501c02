// An array that a plug-in reads or fills: in memory where the plug-in wants it, guarded, grown when needed.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/plugin/memory_space.hpp"
#include "core/result.hpp"

namespace broadside::reference {

// An input. A plug-in that writes to it crashes.
template <typename T>
class PluginInput {
 public:
  explicit PluginInput(core::MemorySpace& space) : space_(&space) {}

  core::Result<const T*> hold(std::span<const T> values) {
    if (block_ == nullptr || values.size() * sizeof(T) > block_->bytes()) {
      auto block = space_->allocate(values.size() * sizeof(T));
      if (!block) return block.error();
      block_ = std::move(block).value();
    }
    block_->unlock();
    if (core::Status status = block_->upload(values.data(), values.size() * sizeof(T)); !status) return status.error();
    block_->lock();
    return static_cast<const T*>(block_->data());
  }

 private:
  core::MemorySpace* space_;
  std::unique_ptr<core::MemoryBlock> block_;
};

// An output, which a plug-in fills. Elements start as bytes 0xFF, so that elements that it only claims to have written
// are found.
template <typename T>
class PluginOutput {
 public:
  explicit PluginOutput(core::MemorySpace& space) : space_(&space) {}

  // A block of exactly `count` elements; memory behind them cannot be written.
  core::Result<T*> room_for(std::size_t count) {
    block_.reset();
    auto block = space_->allocate(count * sizeof(T));
    if (!block) return block.error();
    block_ = std::move(block).value();
    const std::vector<unsigned char> blank(block_->bytes(), 0xFF);
    if (core::Status status = block_->upload(blank.data(), blank.size()); !status) return status.error();
    // The guard begins at the block's end, so the elements are placed at its end.
    return reinterpret_cast<T*>(static_cast<unsigned char*>(block_->data()) + (block_->bytes() - count * sizeof(T)));
  }

  core::Result<std::vector<T>> first(std::size_t count, std::size_t room) const {
    std::vector<unsigned char> bytes(block_->bytes());
    if (core::Status status = block_->download(bytes.data(), bytes.size()); !status) return status.error();
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data() + (bytes.size() - room * sizeof(T)), count * sizeof(T));
    return values;
  }

 private:
  core::MemorySpace* space_;
  std::unique_ptr<core::MemoryBlock> block_;
};

template <typename T>
struct Read {
  std::vector<T> values;
  std::uint64_t demanded = 0;
};

// Asks with room for `guess` elements, and once more when that was too little. read(out, capacity, &demanded): a
// Status.
template <typename T, typename ReadFunction>
core::Result<Read<T>> read_all(core::MemorySpace& space, std::size_t guess, ReadFunction&& read) {
  PluginOutput<T> output(space);
  std::size_t room = guess;
  for (int attempt = 0;; ++attempt) {
    auto memory = output.room_for(room);
    if (!memory) return memory.error();
    std::uint64_t demanded = 0;
    if (core::Status status = read(memory.value(), room, &demanded); !status) return status.error();
    if (demanded > room && attempt == 0) {
      room = static_cast<std::size_t>(demanded);
      continue;
    }
    auto values = output.first(static_cast<std::size_t>(demanded < room ? demanded : room), room);
    if (!values) return values.error();
    return Read<T>{std::move(values).value(), demanded};
  }
}

}  // namespace broadside::reference
