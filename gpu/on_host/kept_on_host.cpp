// Runs the launches that keep pairs between frames on fibers of the host: two blocks of two warps.
#include "gpu/stages/pairs_only/kept.cuh"

namespace broadside::gpu {
namespace {

constexpr on_host::Launch kKeptLaunch{{2}, {64}, 0};

}  // namespace

core::Status launch_fatten(const KeptView& view, StreamHandle /*stream*/) {
  on_host::run(kKeptLaunch, 0, [&](unsigned char*) { run_fatten(view); });
  return core::Done{};
}
core::Status launch_place(const KeptView& view, StreamHandle /*stream*/) {
  on_host::run(kKeptLaunch, 0, [&](unsigned char*) { run_place(view); });
  return core::Done{};
}
core::Status launch_renumber(const KeptView& view, StreamHandle /*stream*/) {
  on_host::run(kKeptLaunch, 0, [&](unsigned char*) { run_renumber(view); });
  return core::Done{};
}
core::Status launch_within(const KeptView& view, StreamHandle /*stream*/) {
  on_host::run(kKeptLaunch, 0, [&](unsigned char*) { run_within(view); });
  return core::Done{};
}
core::Status launch_test(const KeptView& view, StreamHandle /*stream*/) {
  on_host::run(kKeptLaunch, 2 * sizeof(PairQueue), [&](unsigned char* shared) { run_test(view, shared); });
  return core::Done{};
}

}  // namespace broadside::gpu
