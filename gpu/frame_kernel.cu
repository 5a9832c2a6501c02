#include <algorithm>

#include "core/method/frame_digest.hpp"
#include "gpu/cuda_check.hpp"
#include "gpu/frame_kernel.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/contact_stage.cuh"
#include "gpu/stages/grid_stage.cuh"
#include "gpu/stages/proximity_stage.cuh"
#include "gpu/stages/team.cuh"
#include "gpu/stages/tile_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 512;
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;

// Up to this many confirmed pairs and bodies one block resolves them alone: its barrier takes some 30 ns, the grid's
// more than a microsecond, and there is one for every round of the coloring and for every color.
constexpr std::uint64_t kOneBlockPairs = 8192;
constexpr std::uint32_t kOneBlockBodies = 4096;

__device__ unsigned long long now_ns() {
  unsigned long long t;
  asm volatile("mov.u64 %0, %globaltimer;" : "=l"(t));
  return t;
}

template <typename Team>
__device__ void mark(const Team& team, const FrameView& f, int stage) {
  if (team.rank() == 0) f.outcome->stage_end_ns[stage] = now_ns();
}

template <typename Team>
__device__ void report(const Team& team, const FrameView& f, bool is_aborted) {
  if (team.rank() != 0) return;
  f.counters->is_aborted = is_aborted ? 1 : 0;
  f.outcome->counters = *f.counters;
}

// Contacts, faces and the report: what a single block does alone when it is little.
template <typename Team>
__device__ void resolve(const Team& team, const FrameView& f, std::uint64_t confirmed) {
  collect_touching(team, f, confirmed);
  team.sync();
  const std::uint64_t count = f.counters->touching;
  if (f.solver == Solver::kJacobi) {
    resolve_jacobi(team, f, count);
  } else if (f.solver == Solver::kRacing) {
    resolve_racing(team, f, count);
  } else if (count > 0) {
    list_contacts(team, f, count);
    color_contacts(team, f);
    if (f.counters->words_demanded != 0) return report(team, f, true);
    order_by_color(team, f, count);
    resolve_colors(team, f);
  }
  mark(team, f, 5);
  resolve_faces(team, f);
  team.sync();
  mark(team, f, 6);
  report(team, f, f.counters->faces > f.face_contacts.capacity);
}

// A whole frame. Counts are read after barriers, so all threads decide alike.
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    frame_kernel(const __grid_constant__ FrameView f) {
  extern __shared__ __align__(16) unsigned char shared[];
  __shared__ ProximityScratch scratch;
  const GridTeam grid;
  mark(grid, f, 0);
  integrate(grid, f);
  grid.sync();
  mark(grid, f, 1);

  switch (f.start) {
    case Start::kTiles:
    case Start::kSameNode:
      find_pairs_by_tiles(grid, f);
      break;
    case Start::kNone:
      confirm_by_brute_force(grid, f);
      break;
    case Start::kGrid:
      grid_place_buckets(grid, f.grid, &f.counters->grid_cursor);
      grid.sync();
      grid_scatter(grid, f.grid, f.boxes, f.body_count);
      grid.sync();
      grid_find(grid, f.grid, f.body_count, f.pairs, &f.counters->pairs,
                reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32]);
      break;
  }
  grid.sync();
  if (f.start == Start::kGrid) grid_clear(grid, f.grid);
  mark(grid, f, 2);
  if (f.counters->pairs > f.pairs.capacity) return report(grid, f, true);

  // From level 0 alone, what was found is what is confirmed.
  const bool is_confirmed_by_level0 = f.start != Start::kNone && f.levels == core::Levels::kFlat;
  if (f.start != Start::kNone && !is_confirmed_by_level0) {
    confirm_pairs(grid, f);
    grid.sync();
  }
  const std::uint64_t confirmed = is_confirmed_by_level0 ? f.counters->pairs : f.counters->confirmed;
  mark(grid, f, 3);
  if (confirmed > f.confirmed.capacity) return report(grid, f, true);

  if (f.has_vertex_stage && confirmed > 0) {
    measure_proximity(f, confirmed, scratch, shared);
    grid.sync();
  }
  mark(grid, f, 4);

  if (confirmed <= kOneBlockPairs && f.body_count <= kOneBlockBodies) {
    if (blockIdx.x == 0) resolve(BlockTeam{}, f, confirmed);
    return;
  }
  // No more blocks than there is work for: fewer meet sooner.
  const std::uint64_t work = max(confirmed, std::uint64_t{f.body_count});
  const std::uint64_t blocks = min(std::uint64_t{gridDim.x}, (work + blockDim.x - 1) / blockDim.x);
  if (blockIdx.x >= blocks) return;
  resolve(PartialGridTeam{static_cast<std::uint32_t>(blocks), &f.counters->arrived}, f, confirmed);
}

// The broad phase alone: boxes in, pairs out.
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    pairs_kernel(const __grid_constant__ FrameView f) {
  extern __shared__ __align__(16) unsigned char shared[];
  const GridTeam grid;
  if (grid.rank() == 0) *f.counters = Counters{};
  if (f.start == Start::kGrid)
    for (std::uint64_t i = grid.rank(); i < f.body_count; i += grid.size()) grid_count(f.grid, i, unpack(f.boxes[i]));
  grid.sync();
  if (f.start == Start::kGrid) {
    grid_place_buckets(grid, f.grid, &f.counters->grid_cursor);
    grid.sync();
    grid_scatter(grid, f.grid, f.boxes, f.body_count);
    grid.sync();
    grid_find(grid, f.grid, f.body_count, f.pairs, &f.counters->pairs,
              reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32]);
  } else {
    find_pairs_by_tiles(grid, f);
  }
  grid.sync();
  if (f.start == Start::kGrid) grid_clear(grid, f.grid);
  report(grid, f, f.counters->pairs > f.pairs.capacity);
}

constexpr std::uint32_t kDigestThreads = 256;

__global__ void digest_kernel(const DigestView view) {
  const GridTeam grid;
  unsigned long long sum = 0;
  for (std::uint64_t i = grid.rank(); i < view.body_count; i += grid.size())
    sum += core::body_digest(static_cast<std::uint32_t>(i), view.state.position[i].v, view.orientation[i],
                             view.state.velocity[i].v, core::Vec3{});
  for (std::uint64_t k = grid.rank(); k < view.confirmed_count; k += grid.size())
    sum += core::confirmed_digest(view.confirmed[k]);
  for (std::uint64_t k = grid.rank(); k < view.contact_count; k += grid.size())
    if (view.contacts[k].depth_m > 0.0F) sum += core::contact_digest(view.contacts[k]);
  for (std::uint64_t k = grid.rank(); k < view.face_contact_count; k += grid.size())
    sum += core::contact_digest(view.face_contacts[k]);
  for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(kFullWarp, sum, step);
  if (lane() == 0 && sum != 0) atomicAdd(view.sum, sum);
}

}  // namespace

core::Result<LaunchShape> frame_launch_shape(std::uint32_t tree_levels) {
  int device = 0;
  BROADSIDE_CUDA_TRY(cudaGetDevice(&device));
  int multiprocessors = 0;
  int block_limit = 0;
  int is_cooperative = 0;
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device));
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&block_limit, cudaDevAttrMaxSharedMemoryPerBlockOptin, device));
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&is_cooperative, cudaDevAttrCooperativeLaunch, device));
  if (is_cooperative == 0)
    return core::Error{"this GPU cannot launch cooperative kernels", "octree-gpu",
                       "use one of compute capability 7.5 or later", core::Exit::kMissing};
  const std::uint32_t bytes_per_warp = std::max(stack_entries_of(tree_levels) * kBytesPerStackEntry,
                                                static_cast<std::uint32_t>((sizeof(PairQueue) + 15) / 16 * 16));
  for (std::uint32_t threads = kThreads; threads >= 32; threads /= 2) {
    const std::uint32_t bytes = threads / 32 * bytes_per_warp;
    if (bytes + sizeof(ProximityScratch) > static_cast<std::uint32_t>(block_limit)) continue;
    BROADSIDE_CUDA_TRY(
        cudaFuncSetAttribute(frame_kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(bytes)));
    int per_multiprocessor = 0;
    BROADSIDE_CUDA_TRY(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_multiprocessor, frame_kernel,
                                                                     static_cast<int>(threads), bytes));
    if (per_multiprocessor == 0) continue;
    return LaunchShape{threads, static_cast<std::uint32_t>(per_multiprocessor * multiprocessors), bytes,
                       static_cast<std::uint32_t>(multiprocessors)};
  }
  return core::Error{"this GPU has too little shared memory for the vertex trees' stack", "octree-gpu",
                     "use a mesh of fewer vertices", core::Exit::kMissing};
}

core::Status launch_frame(const FrameView& frame, const LaunchShape& shape, cudaStream_t stream) {
  void* arguments[] = {const_cast<FrameView*>(&frame)};
  BROADSIDE_CUDA_TRY(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(frame_kernel), dim3(shape.blocks),
                                                 dim3(shape.threads), arguments, shape.shared_bytes, stream));
  return core::Done{};
}

core::Result<LaunchShape> pairs_launch_shape() {
  int device = 0;
  int multiprocessors = 0;
  int per_multiprocessor = 0;
  const std::uint32_t bytes = kThreads / 32 * sizeof(PairQueue);
  BROADSIDE_CUDA_TRY(cudaGetDevice(&device));
  BROADSIDE_CUDA_TRY(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device));
  BROADSIDE_CUDA_TRY(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_multiprocessor, pairs_kernel,
                                                                   static_cast<int>(kThreads), bytes));
  return LaunchShape{kThreads, static_cast<std::uint32_t>(per_multiprocessor * multiprocessors), bytes,
                     static_cast<std::uint32_t>(multiprocessors)};
}

core::Status launch_pairs(const FrameView& view, const LaunchShape& shape, cudaStream_t stream) {
  void* arguments[] = {const_cast<FrameView*>(&view)};
  BROADSIDE_CUDA_TRY(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(pairs_kernel), dim3(shape.blocks),
                                                 dim3(shape.threads), arguments, shape.shared_bytes, stream));
  return core::Done{};
}

core::Status launch_digest(const DigestView& view, cudaStream_t stream) {
  BROADSIDE_CUDA_TRY(cudaMemsetAsync(view.sum, 0, sizeof *view.sum, stream));
  const std::uint64_t most = std::max({std::uint64_t{view.body_count}, view.confirmed_count, view.contact_count,
                                       view.face_contact_count, std::uint64_t{1}});
  const auto blocks =
      static_cast<unsigned>(std::min<std::uint64_t>((most + kDigestThreads - 1) / kDigestThreads, 1024));
  digest_kernel<<<blocks, kDigestThreads, 0, stream>>>(view);
  BROADSIDE_CUDA_TRY(cudaGetLastError());
  return core::Done{};
}

}  // namespace broadside::gpu
