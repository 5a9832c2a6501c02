#include "gpu/runtime/cuda_check.hpp"
#include "gpu/stages/work.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kWorkThreads = 256;
constexpr std::uint32_t kWorkBlocksPerMultiprocessor = 4;

__global__ void __launch_bounds__(kWorkThreads) broad_work_kernel(const __grid_constant__ BroadWorkView view) {
  __shared__ BulkNotes rooms[kWorkThreads / 32];
  count_broad_work(view, rooms[threadIdx.x / 32]);
}

__global__ void __launch_bounds__(kWorkThreads) level_work_kernel(const __grid_constant__ LevelWorkView view) {
  count_level_work(view);
}

}  // namespace

core::Status launch_broad_work(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  broad_work_kernel<<<kWorkBlocksPerMultiprocessor * multiprocessors, kWorkThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the count of the broad phase's work");
}

core::Status launch_level_work(const LevelWorkView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  level_work_kernel<<<kWorkBlocksPerMultiprocessor * multiprocessors, kWorkThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the count of the levels' work");
}

}  // namespace broadside::gpu
