#include "gpu/on_host/fiber_context.hpp"

namespace broadside::gpu::on_host {

// getcontext() may return twice as far as the compiler knows: not in a loop, whose variables it would not trust then.
[[gnu::noinline]] void FiberContext::begin(unsigned char* stack, std::size_t stack_bytes, void (*entry)()) {
  getcontext(&first_);
  first_.uc_stack.ss_sp = stack;
  first_.uc_stack.ss_size = stack_bytes;
  first_.uc_link = nullptr;
  makecontext(&first_, entry, 0);
  was_left_ = false;
}

#ifdef BROADSIDE_IS_SANITIZED
// A sanitizer follows swapcontext(), and takes a jump to another stack for a mistake.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  swapcontext(&own.first_, &next.first_);
}
#else
// Jumps, since swapcontext() calls the system at every switch, for the mask of signals, which is the same in all
// fibers.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  own.was_left_ = true;
  if (_setjmp(own.again_) != 0) return;
  if (next.was_left_) std::longjmp(next.again_, 1);
  setcontext(&next.first_);
}
#endif

}  // namespace broadside::gpu::on_host
