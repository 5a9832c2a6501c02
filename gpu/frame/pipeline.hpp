// The pipeline on the GPU: METHOD sections 1 to 6, with all state on the device.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/engine/dynamics.hpp"
#include "core/engine/frame_copies.hpp"
#include "core/engine/frame_on_device.hpp"
#include "core/engine/runs_ahead.hpp"
#include "core/engine/work_counting.hpp"
#include "core/method/levels.hpp"
#include "core/variant.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/frame/frame_view.hpp"

namespace broadside::gpu {

struct PipelineOptions {
  // kBrute = the published start, the first of the levels by brute force.
  Broad broad = Broad::kTree;
  float hash_cell_m = 0.0F;                            // of kHash; 0 = the scene's
  std::uint32_t least_for_grid = kLeastBodiesForGrid;  // with fewer bodies kTree tests all pairs
  // Shapes that fewer bodies have get no cells of near vertices, because these cost memory and time at load.
  std::uint32_t least_for_cells = 16;
  core::Levels levels = core::Levels::kC;
  Solver solver = Solver::kColored;
  core::Variant variant = core::Variant::kSound;
  bool has_vertex_stage = true;
};

// Device memory of the last loaded scene, in bytes.
struct MemoryUse {
  std::uint64_t shapes = 0;    // grows with meshes and orientations
  std::uint64_t bodies = 0;    // grows with bodies
  std::uint64_t appended = 0;  // grows with pairs and contacts
};

// The result is bit-identical to octree-cpu's. Uses the current CUDA device; not thread-safe.
class Pipeline final : public core::Dynamics,
                       public core::RunsAhead,
                       public core::FrameCopies,
                       public core::FrameOnDevice,
                       public core::CountsWork {
 public:
  explicit Pipeline(const PipelineOptions& options);
  ~Pipeline() override;

  core::Status load(const core::Scene& scene) override;
  // One kernel launch, repeated from the same state if a buffer was too small. Synchronizes.
  core::Status step(float dt_s) override;
  // The same launches, but each is made before the host has seen how the frame before ended. So the GPU waits for the
  // host only if a buffer was too small.
  core::Status run(float dt_s, std::uint64_t steps, const StepDone& step_done) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] core::Result<core::DeviceFrame> frame_on_device() override;
  core::Status start_copy(core::RecordLevel level) override;
  core::Status finish_copy(core::FrameRecord& frame) override;
  [[nodiscard]] std::uint32_t groups() const override;
  // Read off the GPU's clock within the one kernel: integrate, broad, levels, vertices, response, faces.
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override;
  // Counts launches of the frame kernel, pairs that came to the level stage, and bytes of device memory; if it was
  // asked to count work, also box tests of broad phase and levels, and nodes visited. No count depends on the GPU or on
  // the order of its threads.
  [[nodiscard]] std::vector<core::Counter> counters() const override;

  void count_work() override;

  // Counts of the last step.
  [[nodiscard]] const Counters& frame_counts() const;
  [[nodiscard]] MemoryUse memory_use() const;
  // Frames that were repeated with larger buffers since load.
  [[nodiscard]] std::uint64_t repeated_frames() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu
