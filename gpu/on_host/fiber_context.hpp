// The place at which a fiber, or the scheduler of fibers, goes on when it is switched to.
#pragma once

#include <cstddef>
#include <memory>

namespace broadside::gpu::on_host {

class FiberContext {
 public:
  FiberContext();
  FiberContext(FiberContext&& other) noexcept;
  FiberContext& operator=(FiberContext&& other) noexcept;
  ~FiberContext();

  // The first switch to this context calls `entry`, which must never return, on that stack.
  void begin(unsigned char* stack, std::size_t stack_bytes, void (*entry)());
  // Leaves the running context, `own`, for `next`. Returns when another context switches back to `own`.
  static void switch_over(FiberContext& own, FiberContext& next);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace broadside::gpu::on_host
