// The counts of work on fibers of the host.
#include <vector>

#include "gpu/stages/work.cuh"

namespace broadside::gpu {
namespace {

// Not as many threads as a frame has, because counts must not depend on the number of threads.
constexpr on_host::Launch kWorkLaunch{{3}, {64}, 7};

}  // namespace

core::Status launch_broad_work(const BroadWorkView& view, std::uint32_t /*multiprocessors*/, StreamHandle /*stream*/) {
  on_host::run(kWorkLaunch, sizeof(BulkNotes) * 2, [&](unsigned char* shared) {
    count_broad_work(view, reinterpret_cast<BulkNotes*>(shared)[threadIdx.x / 32]);
  });
  return core::Done{};
}

core::Status launch_level_work(const LevelWorkView& view, std::uint32_t /*multiprocessors*/, StreamHandle /*stream*/) {
  on_host::run(kWorkLaunch, 0, [&](unsigned char*) { count_level_work(view); });
  return core::Done{};
}

}  // namespace broadside::gpu
