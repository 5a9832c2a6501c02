// Constraints of patches in memory, part by part.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/constraint_layout.hpp"

namespace broadside::gpu {

// The constraint at one place.
class TileSlot {
 public:
  __device__ TileSlot(float* constraints, std::uint64_t place)
      : first_(constraints + place / kTile * (kTile * kConstraintWords) + place % kTile) {}

  __device__ float& at(std::uint32_t word) const { return first_[word * kTile]; }
  __device__ float& at(int point, std::uint32_t word) const {
    return at(kPoints + static_cast<std::uint32_t>(point) * kPointWords + word);
  }
  __device__ core::Vec3 vector(std::uint32_t word) const { return {at(word), at(word + 1), at(word + 2)}; }
  __device__ core::Vec3 vector(int point, std::uint32_t word) const {
    return vector(kPoints + static_cast<std::uint32_t>(point) * kPointWords + word);
  }
  __device__ void put(std::uint32_t word, core::Vec3 v) const {
    at(word) = v.x;
    at(word + 1) = v.y;
    at(word + 2) = v.z;
  }
  __device__ void put(int point, std::uint32_t word, core::Vec3 v) const {
    put(kPoints + static_cast<std::uint32_t>(point) * kPointWords + word, v);
  }

 private:
  float* first_;
};

// What no sweep changes, without what only friction or only a bounce needs.
__device__ inline core::PatchConstraint load_bodies_and_points(const TileSlot& slot) {
  core::PatchConstraint c;
  c.a = __float_as_uint(slot.at(kBodyA));
  c.b = __float_as_uint(slot.at(kBodyB));
  c.count = static_cast<int>(__float_as_uint(slot.at(kPointCount)));
  c.normal = slot.vector(kNormal);
  for (int k = 0; k < c.count; ++k) {
    c.points[k].arm_a = slot.vector(k, kArmA);
    c.points[k].arm_b = slot.vector(k, kArmB);
  }
  return c;
}

__device__ inline void load_tangents(const TileSlot& slot, core::PatchConstraint& c) {
  c.tangent_1 = slot.vector(kTangent1);
  c.tangent_2 = slot.vector(kTangent2);
}

__device__ inline void load_surface_and_masses(const TileSlot& slot, core::PatchConstraint& c) {
  c.surface = {slot.at(kSurface), slot.at(kSurface + 1), slot.at(kSurface + 2)};
  c.slop_m = slot.at(kSlop);
  c.fastest_push_m_s = slot.at(kFastestPush);
  for (int k = 0; k < c.count; ++k) {
    core::PatchPoint& p = c.points[k];
    p.gap_m = slot.at(k, kGap);
    p.normal_mass = slot.at(k, kNormalMass);
    p.stick_mass_11 = slot.at(k, kStick11);
    p.stick_mass_12 = slot.at(k, kStick12);
    p.stick_mass_22 = slot.at(k, kStick22);
    p.slide_mass = slot.at(k, kSlideMass);
  }
}

__device__ inline void load_impulses(const TileSlot& slot, core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) {
    core::PatchPoint& p = c.points[k];
    p.normal_impulse = slot.at(k, kImpulses);
    p.tangent_impulse_1 = slot.at(k, kImpulses + 1);
    p.tangent_impulse_2 = slot.at(k, kImpulses + 2);
    p.slides = slot.at(k, kSlides) != 0.0F;
  }
}

__device__ inline void store_impulses(const TileSlot& slot, const core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) {
    const core::PatchPoint& p = c.points[k];
    slot.at(k, kImpulses) = p.normal_impulse;
    slot.at(k, kImpulses + 1) = p.tangent_impulse_1;
    slot.at(k, kImpulses + 2) = p.tangent_impulse_2;
    slot.at(k, kSlides) = p.slides ? 1.0F : 0.0F;
  }
}

__device__ inline void load_approach(const TileSlot& slot, core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) c.points[k].approach_m_s = slot.at(k, kApproach);
}

__device__ inline void store_approach(const TileSlot& slot, const core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) slot.at(k, kApproach) = c.points[k].approach_m_s;
}

__device__ inline void load_stopping(const TileSlot& slot, core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) c.points[k].stopping_impulse = slot.at(k, kStopping);
}

__device__ inline void store_stopping(const TileSlot& slot, const core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) slot.at(k, kStopping) = c.points[k].stopping_impulse;
}

__device__ inline void load_totals(const TileSlot& slot, core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) {
    c.points[k].normal_total = slot.at(k, kTotals);
    c.points[k].tangent_total_1 = slot.at(k, kTotals + 1);
    c.points[k].tangent_total_2 = slot.at(k, kTotals + 2);
  }
}

__device__ inline void store_totals(const TileSlot& slot, const core::PatchConstraint& c) {
  for (int k = 0; k < c.count; ++k) {
    slot.at(k, kTotals) = c.points[k].normal_total;
    slot.at(k, kTotals + 1) = c.points[k].tangent_total_1;
    slot.at(k, kTotals + 2) = c.points[k].tangent_total_2;
  }
}

__device__ inline core::PatchWay load_way(const TileSlot& slot, int count) {
  core::PatchWay way{};
  for (int k = 0; k < count; ++k) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      way.before[k][i] = slot.at(k, kBefore + i);
      way.way[k][i] = slot.at(k, kWay + i);
    }
  }
  return way;
}

__device__ inline void store_before(const TileSlot& slot, int count, const core::PatchWay& way) {
  for (int k = 0; k < count; ++k)
    for (std::uint32_t i = 0; i < 3; ++i) slot.at(k, kBefore + i) = way.before[k][i];
}

__device__ inline void store_direction(const TileSlot& slot, int count, const core::PatchWay& way) {
  for (int k = 0; k < count; ++k)
    for (std::uint32_t i = 0; i < 3; ++i) slot.at(k, kWay + i) = way.way[k][i];
}

// All of it, when it was made.
__device__ inline void store_constraint(const TileSlot& slot, const core::PatchConstraint& c) {
  slot.at(kBodyA) = __uint_as_float(c.a);
  slot.at(kBodyB) = __uint_as_float(c.b);
  slot.at(kPointCount) = __uint_as_float(static_cast<std::uint32_t>(c.count));
  slot.put(kNormal, c.normal);
  slot.put(kTangent1, c.tangent_1);
  slot.put(kTangent2, c.tangent_2);
  slot.put(kSurface, {c.surface.mu_static, c.surface.mu_kinetic, c.surface.restitution});
  slot.at(kSlop) = c.slop_m;
  slot.at(kFastestPush) = c.fastest_push_m_s;
  for (int k = 0; k < c.count; ++k) {
    const core::PatchPoint& p = c.points[k];
    slot.put(k, kArmA, p.arm_a);
    slot.put(k, kArmB, p.arm_b);
    slot.at(k, kGap) = p.gap_m;
    slot.at(k, kNormalMass) = p.normal_mass;
    slot.at(k, kStick11) = p.stick_mass_11;
    slot.at(k, kStick12) = p.stick_mass_12;
    slot.at(k, kStick22) = p.stick_mass_22;
    slot.at(k, kSlideMass) = p.slide_mass;
  }
  store_impulses(slot, c);
  store_approach(slot, c);
  store_totals(slot, c);
}

}  // namespace broadside::gpu
