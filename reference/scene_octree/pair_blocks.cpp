#include "reference/scene_octree/pair_blocks.hpp"

#include <tbb/task_arena.h>

namespace broadside::reference {

void PairBlocks::clear() {
  const auto workers = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  while (writers_.size() < workers) writers_.push_back(std::make_unique<PairWriter>());
  for (auto& writer : writers_) writer->clear();
}

PairWriter& PairBlocks::writer() {
  return *writers_[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
}

std::size_t PairBlocks::count() const {
  std::size_t total = 0;
  for (const auto& writer : writers_) total += writer->count();
  return total;
}

std::span<const std::span<const core::Pair>> PairBlocks::gather() {
  gathered_.clear();
  for (const auto& writer : writers_)
    for (std::size_t k = 0; k < writer->block_count(); ++k)
      if (!writer->block(k).empty()) gathered_.push_back(writer->block(k));
  return gathered_;
}

}  // namespace broadside::reference
