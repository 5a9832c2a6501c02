// The pipeline of bodies that turn, on the GPU: RIGID 8, all state on the device, bit-identical to octree-cpu's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/engine/declaration.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/frame_on_device.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/rigid_settings.hpp"
#include "core/scene/swept_bodies.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/stages/rigid/constraint_layout.hpp"

namespace broadside::gpu {

struct RigidPipelineOptions {
  Broad broad = Broad::kTree;  // kBrute = the levels test all pairs of bodies
  core::Levels levels = core::Levels::kC;
  core::SoftSettings solver;
  bool has_fixed_thresholds = false;  // the scene's
  std::uint32_t least_for_grid = kLeastBodiesForGrid;
  // Which bodies stop before they pass through others when they move farther than they are thick.
  core::Swept swept = core::Swept::kFlagged;
  bool sleeps = false;      // islands that stand still stop being solved
  bool may_cluster = true;  // few contacts are solved by one cluster of blocks, where the GPU has them
  // From how many bodies on the words of constraints lie in pairs, unless a cluster solves them.
  std::uint32_t least_for_pairs = kLeastBodiesForPairs;
};

// Uses the current CUDA device; not thread-safe.
class RigidPipeline final : public core::Dynamics, public core::FrameOnDevice {
 public:
  explicit RigidPipeline(const RigidPipelineOptions& options);
  ~RigidPipeline() override;

  // Refuses what the twin refuses.
  core::Status load(const core::Scene& scene) override;
  // Five launches: boxes, candidate pairs, contacts, constraints, substeps. Contacts take two launches where shapes are
  // hulls or meshes or where bodies are swept; where bodies may sleep there are two more. All are repeated from the
  // same state when an array was too small, when a cell of the broad phase was too small, when the step needs another
  // number of parts, or when a sleeping island wakes. Synchronizes. Returns an error when a body's box is no longer
  // finite.
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] core::Result<core::DeviceFrame> frame_on_device() override;
  [[nodiscard]] std::uint32_t groups() const override;
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override;
  [[nodiscard]] std::vector<core::Counter> counters() const override;

  // Frames that were repeated since load.
  [[nodiscard]] std::uint64_t repeated_frames() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu
