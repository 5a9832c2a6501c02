// The pipeline's stages run one after another, body by body, with any of them replaced: an engine to be wrong in.
#pragma once

#include <memory>
#include <span>

#include "core/engine/dynamics.hpp"
#include "reference/mutants/stages.hpp"
#include "reference/octree_cpu/coloring.hpp"
#include "reference/scene_octree/scene_octree.hpp"

namespace broadside::reference {

// With default stages: octree-cpu[broad=octree], bit for bit. The sound engine knows nothing of this one, so a seam for
// mutations costs it nothing. One thread, because what it runs is small.
class SerialPipeline final : public core::Dynamics {
 public:
  // run: given to the stages, for those that are not determined.
  explicit SerialPipeline(const Stages& stages, std::uint64_t run = 0);

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] std::uint32_t groups() const override;
  // Canonical settings of the engine that it stands for.
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
