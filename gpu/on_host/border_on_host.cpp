// Borders and digests on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/border.cuh"

namespace broadside::gpu {

core::Status launch_borders(const BorderView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_borders(view); });
  return core::Done{};
}

core::Status launch_pair_digest(const PairDigestView& view, StreamHandle /*stream*/) {
  on_host::run({{2}, {64}, 0}, 0, [&](unsigned char*) { run_pair_digest(view); });
  return core::Done{};
}

}  // namespace broadside::gpu
