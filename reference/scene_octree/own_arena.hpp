// Where a broad phase's work runs.
#pragma once

#include <functional>
#include <memory>

namespace broadside::reference {

// Runs work in an arena of its own with the given number of threads, or with 0 in the caller's arena.
class OwnArena {
 public:
  explicit OwnArena(int threads);
  ~OwnArena();
  void execute(const std::function<void()>& work);

 private:
  struct Impl;
  std::unique_ptr<Impl> own_;
};

}  // namespace broadside::reference
