// Where worker threads put the pairs that they find: blocks of fixed size per worker, kept for the next frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pair.hpp"

namespace broadside::reference {

// 256 KiB a block: a worker needs a few blocks, and a block's unused tail is never touched.
inline constexpr std::size_t kPairsPerBlock = std::size_t{1} << 15U;

// One worker's blocks. Not shared between threads.
class PairWriter {
 public:
  void clear() {
    filled_.clear();
    next_ = end_ = nullptr;
    count_ = 0;
  }
  // Room for `wanted` pairs (at most kPairsPerBlock) in one piece; commit says how many were written.
  core::Pair* room(std::size_t wanted) {
    if (static_cast<std::size_t>(end_ - next_) < wanted) open_block();
    return next_;
  }
  void commit(const core::Pair* past_last) {
    const auto written = static_cast<std::size_t>(past_last - next_);
    next_ += written;
    filled_.back() += written;
    count_ += written;
  }
  // The end of the room that is left in the open block.
  [[nodiscard]] core::Pair* end() const { return end_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t block_count() const { return filled_.size(); }
  [[nodiscard]] std::span<const core::Pair> block(std::size_t k) const { return {blocks_[k].get(), filled_[k]}; }

 private:
  void open_block() {
    // for_overwrite: pages that hold no pair are never touched.
    if (filled_.size() == blocks_.size())
      blocks_.push_back(std::make_unique_for_overwrite<core::Pair[]>(kPairsPerBlock));
    next_ = blocks_[filled_.size()].get();
    end_ = next_ + kPairsPerBlock;
    filled_.push_back(0);
  }

  std::vector<std::unique_ptr<core::Pair[]>> blocks_;
  std::vector<std::size_t> filled_;
  core::Pair* next_ = nullptr;
  core::Pair* end_ = nullptr;
  std::size_t count_ = 0;
};

// All workers of the current arena. clear() before each search; writer() inside it.
class PairBlocks {
 public:
  void clear();
  // The calling worker's own.
  PairWriter& writer();
  [[nodiscard]] std::size_t count() const;
  // Every block that holds pairs, in no fixed order.
  [[nodiscard]] std::span<const std::span<const core::Pair>> gather();

 private:
  std::vector<std::unique_ptr<PairWriter>> writers_;
  std::vector<std::span<const core::Pair>> gathered_;
};

}  // namespace broadside::reference
