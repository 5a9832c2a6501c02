#include "gpu/on_host/fiber_context.hpp"

#include <ucontext.h>

#include <csetjmp>

namespace broadside::gpu::on_host {

struct FiberContext::State {
  ucontext_t first;    // where the context begins; where it is, under a sanitizer
  std::jmp_buf again;  // where it is, once it was left
  bool was_left = false;
};

FiberContext::FiberContext() : state_(std::make_unique<State>()) {}
FiberContext::FiberContext(FiberContext&& other) noexcept = default;
FiberContext& FiberContext::operator=(FiberContext&& other) noexcept = default;
FiberContext::~FiberContext() = default;

// getcontext() may return twice as far as the compiler knows: not in a loop, whose variables it would not trust then.
[[gnu::noinline]] void FiberContext::begin(unsigned char* stack, std::size_t stack_bytes, void (*entry)()) {
  ucontext_t& first = state_->first;
  getcontext(&first);
  first.uc_stack.ss_sp = stack;
  first.uc_stack.ss_size = stack_bytes;
  first.uc_link = nullptr;
  makecontext(&first, entry, 0);
  state_->was_left = false;
}

#ifdef BROADSIDE_IS_SANITIZED
// A sanitizer follows swapcontext(), and takes a jump to another stack for a mistake.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  swapcontext(&own.state_->first, &next.state_->first);
}
#else
// Jumps, since swapcontext() calls the system at every switch, for the mask of signals, which is the same in all
// fibers.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  own.state_->was_left = true;
  if (_setjmp(own.state_->again) != 0) return;
  if (next.state_->was_left) std::longjmp(next.state_->again, 1);
  setcontext(&next.state_->first);
}
#endif

}  // namespace broadside::gpu::on_host
