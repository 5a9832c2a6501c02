// Device memory of turning bodies that changes from step to step.
#pragma once

#include <cstdint>
#include <span>

#include "core/method/rigid/kept_patch.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

class RigidBuffers {
 public:
  core::Status load(std::span<const core::RigidState> states, bool may_sleep, bool has_hulls);
  // Wakes all bodies, and forgets for how long they have been still.
  core::Status wake_all();
  // Makes room for what the aborted frame needed.
  core::Status grow(const RigidCounts& demanded);
  // Call when a step is kept: the state after it becomes the state before the next one.
  void advance(const RigidCounts& kept);
  void fill(RigidFrameView& view) const;
  [[nodiscard]] std::uint64_t bytes() const;

  [[nodiscard]] const DeviceBuffer<core::RigidState>& before() const { return before_; }
  [[nodiscard]] const DeviceBuffer<core::RigidState>& after() const { return after_; }
  [[nodiscard]] const DeviceBuffer<PackedBox>& boxes() const { return boxes_; }
  [[nodiscard]] const DeviceBuffer<core::Pair>& confirmed() const { return confirmed_; }
  [[nodiscard]] const DeviceBuffer<core::ContactPatch>& patches() const { return patches_; }
  [[nodiscard]] const DeviceBuffer<core::Vec3>& impulses() const { return impulses_; }

 private:
  struct Memory {
    DeviceBuffer<std::uint32_t> begin;
    DeviceBuffer<std::uint32_t> count;
    DeviceBuffer<std::uint32_t> filled;
    DeviceBuffer<PatchEntry> entries;
    DeviceBuffer<std::uint32_t> feature;
    DeviceBuffer<PackedVec3> impulse;
    DeviceBuffer<core::KeptPatch> kept;  // empty unless there are hulls

    core::Status reserve_bodies(std::size_t bodies);
    core::Status reserve_patches(std::size_t patches, bool has_hulls);
    void swap(Memory& other) noexcept;
    [[nodiscard]] PatchMemory view() const;
    [[nodiscard]] std::uint64_t bytes() const;
  };
  struct Sleep {
    DeviceBuffer<std::uint8_t> asleep;
    DeviceBuffer<std::uint32_t> still;
    DeviceBuffer<std::uint32_t> island;
    DeviceBuffer<std::uint32_t> parent;
    DeviceBuffer<std::uint32_t> restless;
    DeviceBuffer<AsleepPatch> old;
    DeviceBuffer<AsleepPatch> now;
    std::uint64_t old_count = 0;

    core::Status reserve_bodies(std::size_t bodies);
    void fill(RigidFrameView& view) const;
    [[nodiscard]] std::uint64_t bytes() const;
  };
  [[nodiscard]] std::size_t patch_room() const;
  core::Status reserve_confirmed(std::size_t pairs);
  core::Status reserve_patches(std::size_t patches);
  core::Status reserve_places(std::size_t places);
  core::Status reserve_colors(std::size_t colors);

  DeviceBuffer<core::RigidState> before_;
  DeviceBuffer<core::RigidState> after_;
  DeviceBuffer<core::ContactPose> free_end_;
  DeviceBuffer<PackedPusher> pushers_;
  DeviceBuffer<unsigned long long> old_push_;
  DeviceBuffer<unsigned long long> push_;
  DeviceBuffer<unsigned long long> old_passed_on_;
  DeviceBuffer<unsigned long long> passed_on_;
  DeviceBuffer<float> reach_m_;
  DeviceBuffer<float> fall_m_;
  DeviceBuffer<std::uint32_t> pushed_m_;
  DeviceBuffer<core::Box> shape_boxes_;
  DeviceBuffer<PackedBox> boxes_;
  DeviceBuffer<core::Pair> confirmed_;
  DeviceBuffer<NearPair> near_;
  // Empty unless there are hulls.
  DeviceBuffer<core::Pair> fresh_;
  DeviceBuffer<core::Pair> hulls_;
  DeviceBuffer<core::KnownGaps> hull_gaps_;
  DeviceBuffer<core::ContactPatch> patches_;
  DeviceBuffer<PatchRank> ranks_;
  DeviceBuffer<std::uint32_t> patch_colors_;
  DeviceBuffer<BodyColors> coloring_;
  DeviceBuffer<std::uint32_t> color_count_;
  DeviceBuffer<std::uint32_t> color_begin_;
  DeviceBuffer<std::uint32_t> color_cursor_;
  DeviceBuffer<std::uint32_t> patch_at_;
  DeviceBuffer<PackedVec3> constraints_;
  DeviceBuffer<float> changes_;
  DeviceBuffer<std::uint32_t> by_color_;
  DeviceBuffer<PackedSolverBody> bodies_;
  DeviceBuffer<float> inverse_mass_;
  DeviceBuffer<PackedStart> starts_;
  DeviceBuffer<std::uint32_t> stirred_;
  DeviceBuffer<std::uint32_t> relaxed_;
  DeviceBuffer<core::Vec3> impulses_;
  Memory old_memory_;
  Memory memory_;
  bool may_sleep_ = false;
  bool has_hulls_ = false;
  Sleep sleep_;  // empty unless bodies may sleep
  DeviceBuffer<RigidCounts> counts_;
  DeviceBuffer<unsigned long long> barrier_;
  std::size_t colors_ = 0;
};

}  // namespace broadside::gpu
