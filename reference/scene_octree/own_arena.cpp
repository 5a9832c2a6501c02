#include "reference/scene_octree/own_arena.hpp"

#include <tbb/task_arena.h>

namespace broadside::reference {

struct OwnArena::Impl {
  tbb::task_arena arena;
};

OwnArena::OwnArena(int threads) {
  if (threads > 0) own_ = std::make_unique<Impl>(Impl{tbb::task_arena(threads)});
}
OwnArena::~OwnArena() = default;

void OwnArena::execute(const std::function<void()>& work) {
  if (own_ != nullptr)
    own_->arena.execute(work);
  else
    work();
}

}  // namespace broadside::reference
