// The record of an engine of rigid bodies for a frame: states in float64, and the totals of its contact points.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/engine/dynamics.hpp"
#include "reference/rigid_world/rigid_start.hpp"

namespace broadside::reference {

class WorldRecord {
 public:
  // Starts of the scene's bodies; states() are theirs.
  core::Status load(const core::Scene& scene);

  [[nodiscard]] const std::vector<RigidStart>& bodies() const { return bodies_; }
  [[nodiscard]] bool turns() const { return scene_->motion == core::Motion::kRigid; }
  [[nodiscard]] std::vector<RigidState>& states() { return states_; }

  // Call before a step: the present state becomes the pose of detection, and the points of the last step are removed.
  void begin_step();
  // A contact point of bodies or faces a and b, with the impulse (N s) of the whole step on a, and its normal from b to
  // a. If b is the lower body, the two are exchanged here. `gap_m`: negative is penetration.
  void add_point(std::uint32_t a, std::uint32_t b, plain::Vec point, plain::Vec normal, double gap_m,
                 plain::Vec impulse);
  // The broad phase's boxes at detection, one per body, for engines that expose them; such engines record kDetection.
  void set_boxes(std::vector<core::Box> boxes) { boxes_ = std::move(boxes); }

  // Bodies that translate keep their given orientation, bit by bit.
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level);

 private:
  [[nodiscard]] core::WideVec3 origin(const RigidState& state, std::size_t body) const;
  void read_detection(core::FrameRecord& frame);

  const core::Scene* scene_ = nullptr;
  std::uint64_t step_ = 0;
  std::vector<RigidStart> bodies_;
  std::vector<RigidState> states_;
  std::vector<RigidState> detected_;
  std::vector<core::ContactPoint> points_;
  std::vector<core::Box> boxes_;
};

}  // namespace broadside::reference
