#include "gpu/on_host/fiber_context.hpp"

#include <ucontext.h>

#include <csetjmp>

namespace broadside::gpu::on_host {

struct FiberContext::State {
  ucontext_t first;    // where the context begins; under a sanitizer, where it is
  std::jmp_buf again;  // where it goes on, once it was left
  bool was_left = false;
};

FiberContext::FiberContext() : state_(std::make_unique<State>()) {}
FiberContext::FiberContext(FiberContext&& other) noexcept = default;
FiberContext& FiberContext::operator=(FiberContext&& other) noexcept = default;
FiberContext::~FiberContext() = default;

// Not inlined: the compiler must assume that getcontext() returns twice, and in a caller's loop it could then not keep
// variables in registers.
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
// Sanitizers understand swapcontext(), but report a jump to another stack as an error.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  swapcontext(&own.state_->first, &next.state_->first);
}
#else
// Uses jumps, because swapcontext() makes a system call at every switch to set the signal mask, which is the same in
// all fibers.
[[gnu::noinline]] void FiberContext::switch_over(FiberContext& own, FiberContext& next) {
  own.state_->was_left = true;
  if (_setjmp(own.state_->again) != 0) return;
  if (next.state_->was_left) std::longjmp(next.state_->again, 1);
  setcontext(&next.state_->first);
}
#endif

}  // namespace broadside::gpu::on_host
