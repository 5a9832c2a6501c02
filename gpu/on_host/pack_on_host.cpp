// Packing on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/pack.cuh"

namespace broadside::gpu {

core::Status launch_gather(const GatherView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_gather(view); });
  return core::Done{};
}

core::Status launch_pack(const PackView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_pack(view); });
  return core::Done{};
}

}  // namespace broadside::gpu
