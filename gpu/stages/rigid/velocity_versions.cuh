// How patches of a sweep wait for each other without a barrier: by versions of their bodies' velocities.
//
// A body's velocities are two words of 16 bytes, each with the number of its version, and such a word is read and
// written whole. The patches of a body change it one after the other, in the order of their colors. Each knows how many
// come before it, so it knows the version that it waits for, and writes the next one. A sweep begins with the same
// version of all bodies, and the last patch of each body writes the one with which the next sweep begins.
//
// A barrier waits for the slowest warp, and before it arrives a thread's writes must be seen by all: on an H100 that
// takes 760 of the 850 clocks of a cluster's barrier.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"

namespace broadside::gpu {

// One body of a patch, in a sweep that begins with version `base`.
class VelocityVersions {
 public:
  __device__ VelocityVersions(std::uint32_t base, std::uint32_t base_of_next, PlaceInOrder order)
      : awaited_(base + order.before()), left_(order.is_last() ? base_of_next : awaited_ + 1) {}

  // Loads the velocities if they are of the awaited version.
  [[nodiscard]] __device__ __forceinline__ bool try_load(const PackedSolverBody& from, core::SolverBody& b) const {
    const uint4 v = GridWords::load_whole(reinterpret_cast<const uint4*>(&from.v));
    const uint4 spin = GridWords::load_whole(reinterpret_cast<const uint4*>(&from.angular_momentum));
    b.v = {__uint_as_float(v.x), __uint_as_float(v.y), __uint_as_float(v.z)};
    b.angular_momentum = {__uint_as_float(spin.x), __uint_as_float(spin.y), __uint_as_float(spin.z)};
    return !core::is_moved(b) || (v.w == awaited_ && spin.w == awaited_);
  }
  __device__ __forceinline__ void store(PackedSolverBody& to, const core::SolverBody& b) const {
    store_velocity(to, b, left_);
  }

 private:
  std::uint32_t awaited_;
  std::uint32_t left_;
};

}  // namespace broadside::gpu
