// Stops a body partway through its step where it would pass through another body: core/method/rigid/sweep.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/contact.hpp"
#include "core/engine/broad_phase.hpp"
#include "core/math/box.hpp"
#include "core/method/rigid/sweep.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "core/scene/scene.hpp"

namespace broadside::reference {

// The result is a function of the poses: in each round over all pairs a body goes the shortest way that any of its
// pairs allows.
class SweepStage {
 public:
  using MakeBroadPhase = std::function<std::unique_ptr<core::BroadPhase>(const core::Scene&)>;

  // make_broad_phase: empty = every pair is looked at.
  void load(const core::Scene& scene, const core::RigidBodies& bodies, const MakeBroadPhase& make_broad_phase);
  // Follows each body's way from bodies.detected to bodies.state; the state of a body that must stop is set back along
  // it.
  core::Status stop_short(core::RigidBodies& bodies);

  // How many bodies were set back since load; a body counts once for each step.
  [[nodiscard]] std::uint64_t stopped() const { return stopped_; }

 private:
  [[nodiscard]] core::SweptWay way(const core::RigidBodies& bodies, std::uint32_t body) const;
  core::Status find_pairs(const core::RigidBodies& bodies);
  void shorten(const core::RigidBodies& bodies, core::Pair pair);
  void shorten_at_faces(const core::RigidBodies& bodies, std::uint32_t body);

  const core::Scene* scene_ = nullptr;
  std::array<core::ContactShape, core::kFaceCount> face_shapes_;
  std::array<core::ContactPose, core::kFaceCount> face_poses_;
  MakeBroadPhase make_broad_phase_;
  std::unique_ptr<core::BroadPhase> broad_phase_;  // made at the first step in which a body is fast
  float thinnest_m_ = 0.0F;                        // half of the least thickness of all bodies
  std::vector<core::Box> boxes_;                   // of the whole way
  std::vector<core::Pair> pairs_;
  std::vector<std::uint32_t> at_faces_;  // bodies whose ways lead to a face of the domain
  std::vector<std::uint32_t> parts_;     // by body: how many of the core::kPartsOfWay parts of its way it may go
  std::vector<std::uint32_t> next_parts_;
  std::vector<std::uint8_t> is_changed_;
  std::uint64_t stopped_ = 0;
};

}  // namespace broadside::reference
