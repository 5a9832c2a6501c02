// The CPU twin: the pipeline's own stage bodies run on CPU threads. METHOD sections 1 to 6.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/stage.hpp"
#include "core/method/frame_digest.hpp"
#include "core/method/levels.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "reference/octree_cpu/bodies.hpp"
#include "reference/octree_cpu/level_stage.hpp"
#include "reference/octree_cpu/response_stage.hpp"

namespace broadside::reference {

struct PipelineOptions {
  // Makes the broad phase over the scene's domain; empty = the published start: the level stage tests every pair.
  std::function<std::unique_ptr<core::BroadPhase>(const core::Scene&)> make_broad_phase;
  core::Levels levels = core::Levels::kC;
  Solver solver = Solver::kColored;
  core::Variant variant = core::Variant::kSound;
  bool has_vertex_stage = true;
  // The broad phase offers its octree (reference/scene_octree/octree_record.hpp): record it.
  bool records_octree = false;
  int threads = 0;  // 0 = all
};

// Bit-identical for any number of threads: every parallel loop writes to slots of its own, and work whose result
// depends on an order is done in a fixed order.
class Pipeline final : public core::Dynamics {
 public:
  explicit Pipeline(PipelineOptions options);
  ~Pipeline() override;

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] std::uint32_t groups() const override;
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override { return times_; }
  [[nodiscard]] std::vector<core::Counter> counters() const override;

 private:
  core::Status run_stages(float dt_s);
  void integrate(float dt_s);
  core::Status find_candidates();
  void confirm();
  void touch();
  [[nodiscard]] bool has_level0() const;
  [[nodiscard]] std::uint64_t digest() const;
  void tell_octrees(core::FrameRecord& frame);

  struct Threads;  // oneTBB's arena: vendor headers stay in the source

  PipelineOptions options_;
  std::unique_ptr<Threads> threads_;
  const core::Scene* scene_ = nullptr;
  Bodies bodies_;
  std::vector<core::RecordHash> still_digest_;  // of each body: orientation and spin stay as given
  ResponseRules rules_;
  std::unique_ptr<core::BroadPhase> broad_phase_;
  LevelStage level_stage_;
  ResponseStage response_;
  core::PairSet candidates_;
  std::vector<core::Pair> confirmed_;
  std::vector<core::Proximity> proximity_;
  std::vector<core::Pair> touching_;
  std::array<core::StageTime, core::kStageCount> times_{};
  float dt_s_ = 0.0F;
  std::uint64_t steps_ = 0;
  std::optional<std::uint64_t> told_at_;  // the step whose record has the body octrees
};

}  // namespace broadside::reference
