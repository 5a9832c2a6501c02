// Where a fiber, or the scheduler of fibers, goes on when it is switched to.
#pragma once

#include <ucontext.h>

#include <csetjmp>
#include <cstddef>

namespace broadside::gpu::on_host {

class FiberContext {
 public:
  // The first switch to this context calls `entry`, which never returns, on that stack.
  void begin(unsigned char* stack, std::size_t stack_bytes, void (*entry)());
  // Leaves the running context, `own`, for `next`, and returns when somebody switches to `own`.
  static void switch_over(FiberContext& own, FiberContext& next);

 private:
  ucontext_t first_;    // where the context begins; where it is, under a sanitizer
  std::jmp_buf again_;  // where it is, once it was left
  bool was_left_ = false;
};

}  // namespace broadside::gpu::on_host
