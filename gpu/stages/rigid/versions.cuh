// How threads of the solver wait for each other without a barrier: by versions of what they write.
//
// Bodies' velocities, bodies' places and the impulses that patches keep lie in words of 16 bytes, each with the number
// of its version, and such a word is read and written whole.
//
// The patches of a body change its velocities one after the other, in the order of their colors. Each patch knows how
// many patches come before it, so it knows the version that it waits for, and it writes the next one. A sweep begins
// with the same version of all bodies, and the last patch of each body writes the version with which the next sweep
// begins. The body's own thread waits for that version before it moves the body, and before it begins the next substep.
// A body without patches keeps an older version, for which no thread waits.
//
// When a body is moved, its place gets the version with which the sweep after the motion begins, and the patches of
// that sweep wait for it. The impulses that this sweep keeps get the same version, and bodies wait for it when the next
// substep begins.
//
// Nothing is overwritten that is still needed. A body is moved when all its patches have swept, so no patch reads its
// old place any more. It begins a substep when all its patches have relaxed; it has read their impulses by then, which
// they write again only after that substep's sweep.
//
// A barrier, in contrast, waits for the slowest warp, and before a thread arrives its writes must be visible to all
// others: on an H100 that takes 760 of the 850 clocks of a cluster's barrier.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"
#include "core/method/rigid/solver_body.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/place_in_order.cuh"

namespace broadside::gpu {

// By a whole warp: waits until ready() has been true once for each lane that waits. The lanes then go on together;
// otherwise each lane would run the code after the wait alone.
template <typename Ready>
__device__ __forceinline__ void wait_until(bool waits, const Ready& ready) {
  while (__any_sync(kFullWarp, waits)) {
    if (waits) waits = !ready();
    relax();
  }
}

// Three floats and their version, in one access that is never torn.
struct Versioned {
  core::Vec3 v;
  std::uint32_t version = 0;
};
__device__ __forceinline__ Versioned load_versioned(const PackedVec3& from) {
  const uint4 word = GridWords::load_whole(reinterpret_cast<const uint4*>(&from));
  return {{__uint_as_float(word.x), __uint_as_float(word.y), __uint_as_float(word.z)}, word.w};
}
__device__ __forceinline__ void store_versioned(PackedVec3& to, core::Vec3 v, std::uint32_t version) {
  GridWords::store_whole(reinterpret_cast<uint4*>(&to),
                         {__float_as_uint(v.x), __float_as_uint(v.y), __float_as_uint(v.z), version});
}

// Loads what a contact changes of a body. Returns whether it is of this version.
__device__ __forceinline__ bool try_velocity(const PackedSolverBody& from, std::uint32_t version, core::SolverBody& b) {
  const Versioned v = load_versioned(from.v);
  const Versioned spin = load_versioned(from.angular_momentum);
  b.v = v.v;
  b.angular_momentum = spin.v;
  return v.version == version && spin.version == version;
}
__device__ __forceinline__ void store_velocity(PackedSolverBody& to, const core::SolverBody& b, std::uint32_t version) {
  if (!core::is_moved(b)) return;
  store_versioned(to.v, b.v, version);
  store_versioned(to.angular_momentum, b.angular_momentum, version);
}

// Loads what moving a body changes, except its orientation, which no contact reads. Returns whether it is of this
// version.
__device__ __forceinline__ bool try_place(const PackedSolverBody& from, std::uint32_t version, core::SolverBody& b) {
  const Versioned along = load_versioned(from.inertia_along);
  const Versioned across = load_versioned(from.inertia_across);
  const Versioned moved = load_versioned(from.moved);
  const Versioned turned = load_versioned(from.turned);
  b.inverse_inertia = {along.v.x, along.v.y, along.v.z, across.v.x, across.v.y, across.v.z};
  b.moved = moved.v;
  b.turned = turned.v;
  return along.version == version && across.version == version && moved.version == version && turned.version == version;
}
__device__ __forceinline__ void store_place(PackedSolverBody& to, const core::SolverBody& b, std::uint32_t version) {
  const core::Symmetric3& inertia = b.inverse_inertia;
  store_versioned(to.inertia_along, {inertia.xx, inertia.yy, inertia.zz}, version);
  store_versioned(to.inertia_across, {inertia.xy, inertia.xz, inertia.yz}, version);
  store_versioned(to.moved, b.moved, version);
  store_versioned(to.turned, b.turned, version);
}

// The velocities of one body of a patch, in a sweep that begins with version `base`. The body's mass is known.
class VelocityVersions {
 public:
  __device__ VelocityVersions(std::uint32_t base, std::uint32_t base_of_next, PlaceInOrder order)
      : awaited_(base + order.before()), left_(order.is_last() ? base_of_next : awaited_ + 1) {}

  // Loads the velocities if they are of the awaited version.
  [[nodiscard]] __device__ __forceinline__ bool try_load(const PackedSolverBody& from, core::SolverBody& b) const {
    return try_velocity(from, awaited_, b) || !core::is_moved(b);
  }
  __device__ __forceinline__ void store(PackedSolverBody& to, const core::SolverBody& b) const {
    store_velocity(to, b, left_);
  }

 private:
  std::uint32_t awaited_;
  std::uint32_t left_;
};

}  // namespace broadside::gpu
