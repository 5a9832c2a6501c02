// Makes the patches of contact of a step: of confirmed pairs of bodies and of bodies at faces of the domain. RIGID 8.4.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/math/box.hpp"
#include "core/method/rigid/kept_patch.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/pair.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "core/scene/scene.hpp"

namespace broadside::reference {

class PatchStage {
 public:
  // keeps_patches: whether patches are carried along from step to step; not where bodies may sleep.
  void load(const core::Scene& scene, bool keeps_patches);
  // confirmed: sorted pairs. asleep: by body; pairs without an awake body are left out.
  void touch_bodies(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed,
                    std::span<const std::uint8_t> asleep);
  // Call after touch_bodies. patches: of both stages, sorted by (a, b), so that a body's patches with bodies come
  // before those with faces. Static bodies touch no face, and sleeping ones are left out.
  void touch_faces(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed,
                   std::span<const std::uint8_t> asleep, std::vector<core::ContactPatch>& patches);
  // The patches of pairs, after touch_bodies.
  [[nodiscard]] std::span<const core::ContactPatch> of_bodies() const { return of_pairs_; }
  // Since load.
  [[nodiscard]] std::uint64_t patches_made() const { return patches_made_; }
  // Of these, how many were carried from the step before.
  [[nodiscard]] std::uint64_t patches_carried() const { return patches_carried_; }

 private:
  struct KeptOfPair {
    core::Pair pair;
    core::KeptPatch kept;
  };
  struct Block {
    std::vector<core::ContactPatch> patches;
    std::vector<KeptOfPair> kept;
    std::uint64_t carried = 0;
    void clear() {
      patches.clear();
      kept.clear();
      carried = 0;
    }
  };

  [[nodiscard]] const core::KeptPatch* carry(const core::RigidBodies& bodies, core::Pair pair,
                                             const core::PairAhead& ahead, core::Manifold& out) const;
  void touch_pair(const core::RigidBodies& bodies, core::Pair pair, Block& block) const;

  void find_pushed_reach(const core::RigidBodies& bodies, std::span<const core::Pair> confirmed);

  [[nodiscard]] bool is_passing(const core::RigidBodies& bodies, core::Pair pair, const core::Manifold& found) const;

  core::Box domain_;
  std::array<core::ContactShape, core::kFaceCount> face_shapes_;
  std::array<core::ContactPose, core::kFaceCount> face_poses_;
  // One list for each run of pairs or bodies, filled by one thread. Joined in this order they are sorted.
  std::vector<Block> pair_blocks_;
  std::vector<Block> face_blocks_;
  std::vector<core::ContactPatch> of_pairs_;
  std::vector<core::ContactPatch> of_faces_;
  // Patches to carry along, of pairs of hulls, sorted: of this step and of the one before.
  bool keeps_patches_ = false;
  std::vector<KeptOfPair> kept_;
  std::vector<KeptOfPair> last_kept_;
  std::vector<float> pushed_reach_m_;  // by body
  std::uint64_t patches_made_ = 0;
  std::uint64_t patches_carried_ = 0;
};

}  // namespace broadside::reference
