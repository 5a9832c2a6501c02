#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/pairs_only/kept.cuh"

namespace broadside::gpu {
namespace {

__global__ void __launch_bounds__(kPlainThreads) fatten_kernel(const __grid_constant__ KeptView view) {
  run_fatten(view);
}
__global__ void __launch_bounds__(kPlainThreads) place_kernel(const __grid_constant__ KeptView view) {
  run_place(view);
}
__global__ void __launch_bounds__(kPlainThreads) renumber_kernel(const __grid_constant__ KeptView view) {
  run_renumber(view);
}
__global__ void __launch_bounds__(kPlainThreads) within_kernel(const __grid_constant__ KeptView view) {
  run_within(view);
}
__global__ void __launch_bounds__(kPlainThreads) test_kernel(const __grid_constant__ KeptView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_test(view, shared);
}

}  // namespace

core::Status launch_fatten(const KeptView& view, StreamHandle stream) {
  return launch_over(view.count, fatten_kernel, view, stream);
}
core::Status launch_place(const KeptView& view, StreamHandle stream) {
  return launch_over(view.count, place_kernel, view, stream);
}
core::Status launch_renumber(const KeptView& view, StreamHandle stream) {
  return launch_over(view.candidate_count, renumber_kernel, view, stream);
}
core::Status launch_within(const KeptView& view, StreamHandle stream) {
  return launch_over(view.count, within_kernel, view, stream);
}
core::Status launch_test(const KeptView& view, StreamHandle stream) {
  constexpr auto kShared = static_cast<std::uint32_t>(kPlainThreads / 32 * sizeof(PairQueue));
  return launch_over(view.candidate_count, test_kernel, view, stream, kShared);
}

}  // namespace broadside::gpu
