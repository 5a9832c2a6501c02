// Loads and stores constraints of patches, part by part. All four points are loaded, whether the patch has them or not,
// because a load that waits for the number of points costs more than a load that is not needed.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/pushed_apart.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/constraint_layout.hpp"
#include "gpu/stages/rigid/place_in_order.cuh"
#include "gpu/stages/rigid/versions.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kFourPoints = core::kManifoldPoints;

// The constraint at one place.
class TileSlot {
 public:
  TileSlot() = default;  // of no constraint
  __device__ TileSlot(const ConstraintMemory& memory, std::uint64_t place)
      : even_(memory.words + place / kTile * kTileWords + place % kTile * (memory.has_pairs ? 2 : 1)),
        odd_(even_ + (memory.has_pairs ? 1 : kTile)) {}

  __device__ PackedVec3& at(std::uint32_t word) const { return (word % 2 == 0 ? even_ : odd_)[word / 2 * (2 * kTile)]; }
  // The four numbers of a word that has one number for each point.
  __device__ void load_each(std::uint32_t word, float (&numbers)[kFourPoints]) const {
    const PackedVec3 w = at(word);
    numbers[0] = w.v.x;
    numbers[1] = w.v.y;
    numbers[2] = w.v.z;
    numbers[3] = w.w;
  }
  __device__ void store_each(std::uint32_t word, const float (&numbers)[kFourPoints]) const {
    at(word) = {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
  }

 private:
  PackedVec3* even_ = nullptr;
  PackedVec3* odd_ = nullptr;
};

// The indices of the bodies, the number of points, the slop and the fastest push.
__device__ __forceinline__ void load_bodies(const TileSlot& slot, core::PatchConstraint& c) {
  const PackedVec3 bodies = slot.at(kPatchBodies);
  const std::uint32_t packed = __float_as_uint(bodies.v.x);
  c.a = packed & ((1U << kCountShift) - 1U);
  c.count = static_cast<int>(packed >> kCountShift);
  c.b = __float_as_uint(bodies.v.y);
  c.slop_m = bodies.v.z;
  c.fastest_push_m_s = bodies.w;
}

// The directions, and the surface, which lies in the same words. Returns the vector from A's center of mass to B's.
__device__ __forceinline__ core::Vec3 load_directions(const TileSlot& slot, core::PatchConstraint& c) {
  const PackedVec3 normal = slot.at(kNormal);
  const PackedVec3 tangent = slot.at(kTangent);
  const PackedVec3 across = slot.at(kAcross);
  c.normal = normal.v;
  c.tangent_1 = tangent.v;
  c.tangent_2 = core::cross(normal.v, tangent.v);
  c.surface = {normal.w, tangent.w, across.w};
  return across.v;
}

__device__ __forceinline__ void load_levers(const TileSlot& slot, core::PatchConstraint& c) {
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) {
    const PackedVec3 lever = slot.at(kLevers + k);
    c.points[k].lever = lever.v;
    c.points[k].gap_m = lever.w;
  }
}

// across: from load_directions. B's arm is computed by the same subtraction as when the constraint was made, so it has
// the same bits.
__device__ __forceinline__ void set_centers(core::Vec3 center_a, core::Vec3 across, core::PatchConstraint& c) {
  c.center_a = center_a;
  c.center_b = center_a - across;
}

// The arms alone, without the other numbers of these words.
constexpr std::uint32_t kMobilityNumbers = 21;
constexpr std::uint32_t kMobilityWords = kOrder - kMobility;
static_assert(kMobilityNumbers + 3 == 4 * kMobilityWords, "the mobility and the center fill their words");
__device__ __forceinline__ void load_centers(const TileSlot& slot, core::Vec3 across, core::PatchConstraint& c) {
  const PackedVec3 last = slot.at(kMobility + kMobilityWords - 1);
  set_centers({last.v.y, last.v.z, last.w}, across, c);
}

__device__ __forceinline__ void load_mobility(const TileSlot& slot, core::Vec3 across, core::PatchConstraint& c) {
  float numbers[4 * kMobilityWords];
#pragma unroll
  for (std::uint32_t i = 0; i < kMobilityWords; ++i) {
    const PackedVec3 word = slot.at(kMobility + i);
    numbers[4 * i] = word.v.x;
    numbers[4 * i + 1] = word.v.y;
    numbers[4 * i + 2] = word.v.z;
    numbers[4 * i + 3] = word.w;
  }
  int next = 0;
  core::each_of_mobilities(c.mobility, c.mobility, [&](float& number, float&) { number = numbers[next++]; });
  set_centers({numbers[21], numbers[22], numbers[23]}, across, c);
}

__device__ __forceinline__ void store_mobility(const TileSlot& slot, const core::PatchConstraint& c) {
  float numbers[4 * kMobilityWords];
  int next = 0;
  core::each_of_mobilities(c.mobility, c.mobility,
                           [&](const float& number, const float&) { numbers[next++] = number; });
  numbers[21] = c.center_a.x;
  numbers[22] = c.center_a.y;
  numbers[23] = c.center_a.z;
#pragma unroll
  for (std::uint32_t i = 0; i < kMobilityWords; ++i)
    slot.at(kMobility + i) = {{numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]}, numbers[4 * i + 3]};
}

__device__ __forceinline__ void load_masses(const TileSlot& slot, core::PatchConstraint& c) {
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) {
    const PackedVec3 masses = slot.at(kMasses + k);
    c.points[k].normal_mass = masses.v.x;
    c.points[k].stick_mass_11 = masses.v.y;
    c.points[k].stick_mass_12 = masses.v.z;
    c.points[k].stick_mass_22 = masses.w;
  }
}

// The slip mobilities are stored with the impulses.
__device__ __forceinline__ void store_masses(const TileSlot& slot, const core::PatchConstraint& c) {
  core::each_point(c, [&](int k) {
    const core::PatchPoint& p = c.points[k];
    slot.at(kMasses + static_cast<std::uint32_t>(k)) = {{p.normal_mass, p.stick_mass_11, p.stick_mass_12},
                                                        p.stick_mass_22};
  });
}

// The slip mobility is positive; it is stored with the opposite sign where the point slides.
__device__ __forceinline__ void load_impulses(const TileSlot& slot, core::PatchConstraint& c) {
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) {
    const PackedVec3 impulse = slot.at(kImpulses + k);
    core::PatchPoint& p = c.points[k];
    p.normal_impulse = impulse.v.x;
    p.tangent_impulse_1 = impulse.v.y;
    p.tangent_impulse_2 = impulse.v.z;
    p.slides = (__float_as_uint(impulse.w) & 0x80000000U) != 0;
    p.slip_mobility = __uint_as_float(__float_as_uint(impulse.w) & 0x7FFFFFFFU);
  }
}

__device__ __forceinline__ void store_impulses(const TileSlot& slot, const core::PatchConstraint& c) {
  core::each_point_or_zeros(c, [&](int k) {
    const core::PatchPoint& p = c.points[k];
    const std::uint32_t sign = p.slides ? 0x80000000U : 0U;
    slot.at(kImpulses + static_cast<std::uint32_t>(k)) = {{p.normal_impulse, p.tangent_impulse_1, p.tangent_impulse_2},
                                                          __uint_as_float(__float_as_uint(p.slip_mobility) | sign)};
  });
}

// Stores the sum of the patch's impulses, which its bodies get when the next substep begins (warm start). Levers and
// directions must have been loaded.
__device__ __forceinline__ void store_given(const TileSlot& slot, const core::PatchConstraint& c,
                                            std::uint32_t version) {
  const core::WorldPushOf<float> given = core::whole_push(c);
  store_versioned(slot.at(kGiven), given.impulse, version);
  store_versioned(slot.at(kGiven + 1), given.moment, version);
}
// That sum, in whichever version is there now.
struct LoadedGiven {
  Versioned impulse;
  Versioned moment;

  [[nodiscard]] __device__ bool is_of(std::uint32_t version) const {
    return impulse.version == version && moment.version == version;
  }
};
__device__ __forceinline__ LoadedGiven load_given(const TileSlot& slot) {
  return {load_versioned(slot.at(kGiven)), load_versioned(slot.at(kGiven + 1))};
}

// Stores impulses that may be the last ones of a substep. version: that of the impulses with which the next substep
// begins.
__device__ __forceinline__ void store_kept_impulses(const TileSlot& slot, const core::PatchConstraint& c,
                                                    std::uint32_t version) {
  store_impulses(slot, c);
  store_given(slot, c, version);
}

// What a sweep reads.
__device__ __forceinline__ core::PatchConstraint load_for_sweep(const TileSlot& slot) {
  core::PatchConstraint c;
  load_bodies(slot, c);
  const core::Vec3 across = load_directions(slot, c);
  load_levers(slot, c);
  load_masses(slot, c);
  load_mobility(slot, across, c);
  load_impulses(slot, c);
  return c;
}

__device__ __forceinline__ void load_approach(const TileSlot& slot, core::PatchConstraint& c) {
  float all[kFourPoints];
  slot.load_each(kApproaches, all);
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) c.points[k].approach_m_s = all[k];
}

__device__ __forceinline__ void store_approach(const TileSlot& slot, const core::PatchConstraint& c) {
  float all[kFourPoints] = {};
  core::each_point(c, [&](int k) { all[k] = c.points[k].approach_m_s; });
  slot.store_each(kApproaches, all);
}

__device__ __forceinline__ void load_totals(const TileSlot& slot, core::PatchConstraint& c) {
  float all[3][kFourPoints];
#pragma unroll
  for (std::uint32_t i = 0; i < 3; ++i) slot.load_each(kTotals + i, all[i]);
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) {
    c.points[k].normal_total = all[0][k];
    c.points[k].tangent_total_1 = all[1][k];
    c.points[k].tangent_total_2 = all[2][k];
  }
}

__device__ __forceinline__ void store_totals(const TileSlot& slot, const core::PatchConstraint& c) {
  float all[3][kFourPoints] = {};
  core::each_point(c, [&](int k) {
    all[0][k] = c.points[k].normal_total;
    all[1][k] = c.points[k].tangent_total_1;
    all[2][k] = c.points[k].tangent_total_2;
  });
#pragma unroll
  for (std::uint32_t i = 0; i < 3; ++i) slot.store_each(kTotals + i, all[i]);
}

// Loads what decides whether a point bounces, if the patch may bounce; a patch that may not has restitution 0 in this
// step. Call after load_directions.
__device__ __forceinline__ void load_impact(const TileSlot& slot, core::PatchConstraint& c) {
  if (!(c.surface.restitution > 0.0F)) return;
  load_approach(slot, c);
  load_totals(slot, c);
}

// Three numbers of each point: `word` is kBefore, kWays or kPushed.
__device__ __forceinline__ void load_triples(const TileSlot& slot, std::uint32_t word,
                                             float (&triples)[kFourPoints][3]) {
#pragma unroll
  for (std::uint32_t i = 0; i < 3; ++i) {
    float all[kFourPoints];
    slot.load_each(word + i, all);
#pragma unroll
    for (std::uint32_t k = 0; k < kFourPoints; ++k) triples[k][i] = all[k];
  }
}

__device__ __forceinline__ void store_triples(const TileSlot& slot, std::uint32_t word,
                                              const float (&triples)[kFourPoints][3]) {
#pragma unroll
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float all[kFourPoints] = {triples[0][i], triples[1][i], triples[2][i], triples[3][i]};
    slot.store_each(word + i, all);
  }
}

// The budget of impulse that a patch that bounces has left from sweep to sweep. kBouncesNot marks a patch that does not
// bounce: no budget is so low, because a budget is the rest of a positive number.
constexpr float kBouncesNot = -3.402823e38F;
__device__ __forceinline__ float load_budget(const TileSlot& slot) {
  return slot.at(kRelaxed).v.x;
}
__device__ __forceinline__ void store_budget(const TileSlot& slot, float budget_n_s) {
  slot.at(kRelaxed) = {{budget_n_s, 0.0F, 0.0F}, 0.0F};
}
// The latest relaxation along directions, named by its first sweep, that has visited the patch: its direction is kept.
// 0 = none of this step, and none since it bounced.
__device__ __forceinline__ std::uint32_t load_relaxed(const TileSlot& slot) {
  return __float_as_uint(slot.at(kRelaxed).w);
}
__device__ __forceinline__ void store_relaxed(const TileSlot& slot, std::uint32_t since) {
  slot.at(kRelaxed) = {{0.0F, 0.0F, 0.0F}, __uint_as_float(since)};
}

// Stores the impulses before the push of a patch that is pushed apart; for other patches only a mark.
__device__ __forceinline__ void store_before_push(const TileSlot& slot, const core::PatchConstraint& c,
                                                  bool is_pushed) {
  if (!is_pushed) {
    slot.at(kPushed) = {{-1.0F, 0.0F, 0.0F}, 0.0F};
    return;
  }
  store_triples(slot, kPushed, core::impulses_before(c).of);
}

// Whether the patch is pushed apart.
__device__ __forceinline__ bool load_before_push(const TileSlot& slot, core::PatchImpulsesBefore& before) {
  load_triples(slot, kPushed, before.of);
  return !(before.of[0][0] < 0.0F);
}

__device__ __forceinline__ PatchOrder load_order(const TileSlot& slot, core::SolverBody& a, core::SolverBody& b) {
  const PackedVec3 word = slot.at(kOrder);
  a.inverse_mass = word.v.z;
  b.inverse_mass = word.w;
  return {PlaceInOrder(__float_as_uint(word.v.x)), PlaceInOrder(__float_as_uint(word.v.y))};
}
// side: 0 for A, 1 for B.
__device__ inline void store_order(const TileSlot& slot, std::uint32_t side, PlaceInOrder order) {
  (side == 0 ? slot.at(kOrder).v.x : slot.at(kOrder).v.y) = __uint_as_float(order.word());
}

// Stores a constraint that was just made, except its order. Points that the patch does not have are zeros.
__device__ inline void store_constraint(const TileSlot& slot, core::PatchConstraint& c, core::Vec3 across,
                                        const core::SolverBody& a, const core::SolverBody& b) {
  for (int k = c.count; k < core::kManifoldPoints; ++k) c.points[k] = {};
  const std::uint32_t packed = c.a | static_cast<std::uint32_t>(c.count) << kCountShift;
  slot.at(kPatchBodies) = {{__uint_as_float(packed), __uint_as_float(c.b), c.slop_m}, c.fastest_push_m_s};
  slot.at(kNormal) = {c.normal, c.surface.mu_static};
  slot.at(kTangent) = {c.tangent_1, c.surface.mu_kinetic};
  slot.at(kAcross) = {across, c.surface.restitution};
#pragma unroll
  for (std::uint32_t k = 0; k < kFourPoints; ++k) {
    const core::PatchPoint& p = c.points[k];
    slot.at(kLevers + k) = {p.lever, p.gap_m};
    slot.at(kMasses + k) = {{p.normal_mass, p.stick_mass_11, p.stick_mass_12}, p.stick_mass_22};
    slot.at(kImpulses + k) = {{p.normal_impulse, p.tangent_impulse_1, p.tangent_impulse_2}, p.slip_mobility};
  }
  store_given(slot, c, 0);
  store_mobility(slot, c);
  slot.at(kOrder).v.z = a.inverse_mass;
  slot.at(kOrder).w = b.inverse_mass;
  store_approach(slot, c);
  store_relaxed(slot, 0);
  const float none[kFourPoints] = {};
  for (std::uint32_t i = 0; i < 3; ++i) slot.store_each(kTotals + i, none);
}

}  // namespace broadside::gpu
