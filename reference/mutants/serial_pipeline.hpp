// The pipeline's stages, one after another, body by body; any of them can be replaced: the base of wrong engines.
#pragma once

#include <memory>
#include <span>

#include "core/engine/dynamics.hpp"
#include "reference/mutants/stages.hpp"
#include "reference/octree_cpu/coloring.hpp"
#include "reference/scene_octree/scene_octree.hpp"

namespace broadside::reference {

// With default stages: octree-cpu[broad=octree], bit for bit. The sound engine has no hooks for mutations, so they cost
// it nothing. One thread, because the scenes that it runs are small.
class SerialPipeline final : public core::Dynamics {
 public:
  // run: handed to the stages, for mutants that differ from run to run.
  explicit SerialPipeline(const Stages& stages, std::uint64_t run = 0);

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] std::uint32_t groups() const override;
  // Canonical settings of the engine that it imitates.
  static const char* settings();

 private:
  void integrate();
  void find_candidates();
  void confirm();
  void resolve_bodies();
  void resolve_faces();
  void apply(core::Contact& contact, const core::ContactGeometry& geometry, float w_b, const core::Material& material);
  [[nodiscard]] bool is_written(std::uint32_t body) const;

  Stages stages_;
  World world_;
  SceneOctree octree_;
  Coloring coloring_;
};

}  // namespace broadside::reference
