// Where a broad phase's work runs.
#pragma once

#include <tbb/task_arena.h>

#include <optional>
#include <utility>

namespace broadside::reference {

// Runs work in an arena of its own with so many threads, or with 0 in the caller's.
class OwnArena {
 public:
  explicit OwnArena(int threads) {
    if (threads > 0) own_.emplace(threads);
  }
  template <typename Work>
  void execute(Work&& work) {
    if (own_)
      own_->execute(std::forward<Work>(work));
    else
      work();
  }

 private:
  std::optional<tbb::task_arena> own_;
};

}  // namespace broadside::reference
