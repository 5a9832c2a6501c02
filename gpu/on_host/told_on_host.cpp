// Runs the launch that reports a frame of turning bodies on fibers of the host: two blocks of two warps.
#include "gpu/stages/rigid/told_stage.cuh"

namespace broadside::gpu {

core::Status launch_told(const ToldView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_told(view); });
  return core::Done{};
}

}  // namespace broadside::gpu
