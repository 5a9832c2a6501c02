// The kernels over tiles of patches, as text that is compiled once for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "core/math/lane_number.hpp"
#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/pushed_apart.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"
#include "reference/octree_cpu/rigid/patch_kernels.hpp"

namespace broadside::reference::tiles {

// core::Symmetric3 of several patches, side by side.
template <typename Lanes>
struct LaneSymmetric3 {
  Lanes xx, yy, zz, xy, xz, yz;

  friend core::LaneVec3<Lanes> operator*(const LaneSymmetric3& m, const core::LaneVec3<Lanes>& v) {
    return {(m.xx * v.x + m.xy * v.y) + m.xz * v.z, (m.xy * v.x + m.yy * v.y) + m.yz * v.z,
            (m.xz * v.x + m.yz * v.y) + m.zz * v.z};
  }
};

// Bodies are read and written in words of four floats, in the order in which core::SolverBody has them.
static_assert(offsetof(core::SolverBody, v) == 0 && offsetof(core::SolverBody, angular_momentum) == 12 &&
              offsetof(core::SolverBody, inverse_inertia) == 24 && offsetof(core::SolverBody, inverse_mass) == 48 &&
              offsetof(core::SolverBody, moved) == 52 && offsetof(core::SolverBody, turned) == 64);

template <typename Lanes>
struct LaneBody {
  using Number = Lanes;

  core::LaneVec3<Lanes> v;
  core::LaneVec3<Lanes> angular_momentum;
  LaneSymmetric3<Lanes> inverse_inertia;
  Lanes inverse_mass;
  core::LaneVec3<Lanes> moved;
  core::LaneVec3<Lanes> turned;

  LaneBody(const core::SolverBody* bodies, const std::uint32_t (&ids)[kTileLanes]) {
    const float* at[kTileLanes];
    for (std::uint32_t lane = 0; lane < kTileLanes; ++lane)
      at[lane] = reinterpret_cast<const float*>(bodies + ids[lane]);
    Lanes ignored;
    Lanes::load_words(at, 0, v.x, v.y, v.z, angular_momentum.x);
    Lanes::load_words(at, 4, angular_momentum.y, angular_momentum.z, inverse_inertia.xx, inverse_inertia.yy);
    Lanes::load_words(at, 8, inverse_inertia.zz, inverse_inertia.xy, inverse_inertia.xz, inverse_inertia.yz);
    Lanes::load_words(at, 12, inverse_mass, moved.x, moved.y, moved.z);
    Lanes::load_words(at, 16, turned.x, turned.y, turned.z, ignored);
  }
  // Writes the velocities of bodies that move.
  void store(core::SolverBody* bodies, const std::uint32_t (&ids)[kTileLanes]) const {
    float* at[kTileLanes];
    for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) at[lane] = reinterpret_cast<float*>(bodies + ids[lane]);
    const unsigned moves = lanes_of(core::is_moved(*this));
    Lanes::store_words(at, 0, moves, v.x, v.y, v.z, angular_momentum.x);
    Lanes::store_words(at, 4, moves, angular_momentum.y, angular_momentum.z, inverse_inertia.xx, inverse_inertia.yy);
  }
};

template <typename Lanes>
struct Tile {
  core::PatchOf<Lanes> patch;
  Lanes gaps[core::kManifoldPoints];  // at the start of the substep
  core::PatchWayOf<Lanes> way;
  std::uint32_t a[kTileLanes];
  std::uint32_t b[kTileLanes];

  static Tile& at(std::byte* tiles, std::size_t k) { return *std::launder(reinterpret_cast<Tile*>(tiles) + k); }
  static const Tile& at(const std::byte* tiles, std::size_t k) {
    return *std::launder(reinterpret_cast<const Tile*>(tiles) + k);
  }
};

template <typename Lanes>
void clear(std::byte* tiles, std::size_t tile, std::uint32_t still) {
  Tile<Lanes>& t = *new (tiles + tile * sizeof(Tile<Lanes>)) Tile<Lanes>{};
  for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) t.a[lane] = t.b[lane] = still;
  for (core::PatchPointOf<Lanes>& p : t.patch.points) p.normal_mass = p.slide_mass = 1.0F;  // others divide by them
}

// visit(x, y) for every number x of a tile's patch and the same number y of one patch.
template <typename Patches, typename Patch, typename Visit>
void each_number(Patches& many, Patch& one, const Visit& visit) {
  const auto vector = [&](auto& of_many, auto& of_one) {
    visit(of_many.x, of_one.x);
    visit(of_many.y, of_one.y);
    visit(of_many.z, of_one.z);
  };
  vector(many.normal, one.normal);
  vector(many.tangent_1, one.tangent_1);
  vector(many.tangent_2, one.tangent_2);
  vector(many.center_a, one.center_a);
  vector(many.center_b, one.center_b);
  core::each_of_mobilities(many.mobility, one.mobility, visit);
  visit(many.surface.mu_static, one.surface.mu_static);
  visit(many.surface.mu_kinetic, one.surface.mu_kinetic);
  visit(many.surface.restitution, one.surface.restitution);
  visit(many.slop_m, one.slop_m);
  visit(many.fastest_push_m_s, one.fastest_push_m_s);
  visit(many.budget_n_s, one.budget_n_s);
  for (int k = 0; k < many.count; ++k) {
    auto& p = many.points[k];
    auto& q = one.points[k];
    vector(p.lever, q.lever);
    visit(p.gap_m, q.gap_m);
    visit(p.normal_mass, q.normal_mass);
    visit(p.stick_mass_11, q.stick_mass_11);
    visit(p.stick_mass_12, q.stick_mass_12);
    visit(p.stick_mass_22, q.stick_mass_22);
    visit(p.slide_mass, q.slide_mass);
    visit(p.normal_impulse, q.normal_impulse);
    visit(p.tangent_impulse_1, q.tangent_impulse_1);
    visit(p.tangent_impulse_2, q.tangent_impulse_2);
    visit(p.normal_total, q.normal_total);
    visit(p.tangent_total_1, q.tangent_total_1);
    visit(p.tangent_total_2, q.tangent_total_2);
    visit(p.approach_m_s, q.approach_m_s);
    visit(p.slides, q.slides);
  }
}

template <typename Lanes>
void put(std::byte* tiles, std::size_t tile, std::uint32_t lane, const core::PatchConstraint& c) {
  Tile<Lanes>& t = Tile<Lanes>::at(tiles, tile);
  t.a[lane] = c.a;
  t.b[lane] = c.b;
  t.patch.count = c.count;
  each_number(t.patch, c, [lane](auto& of_many, const auto& of_one) { of_many.set(lane, of_one); });
}

template <typename Lanes>
core::PatchConstraint get(const std::byte* tiles, std::size_t tile, std::uint32_t lane) {
  const Tile<Lanes>& t = Tile<Lanes>::at(tiles, tile);
  core::PatchConstraint c;
  c.a = t.a[lane];
  c.b = t.b[lane];
  c.count = t.patch.count;
  each_number(t.patch, c, [lane](const auto& of_many, auto& of_one) { of_one = of_many.get(lane); });
  return c;
}

// work(tile, a, b) only reads its bodies.
template <typename Lanes, typename Work>
void each_tile(const TileRange& range, const Work& work) {
  for (std::size_t k = range.first; k < range.last; ++k) {
    Tile<Lanes>& t = Tile<Lanes>::at(range.tiles, k);
    work(t, LaneBody<Lanes>(range.bodies, t.a), LaneBody<Lanes>(range.bodies, t.b), k);
  }
}

// work(tile, a, b) changes the velocities of its bodies.
template <typename Lanes, typename Work>
void each_tile_moving(const TileRange& range, const Work& work) {
  for (std::size_t k = range.first; k < range.last; ++k) {
    Tile<Lanes>& t = Tile<Lanes>::at(range.tiles, k);
    LaneBody<Lanes> a(range.bodies, t.a);
    LaneBody<Lanes> b(range.bodies, t.b);
    work(t, a, b, k);
    a.store(range.bodies, t.a);
    b.store(range.bodies, t.b);
  }
}

template <typename Lanes>
void begin_sweeps(const TileRange& range, const core::SoftStep& step, float* speeds, float* pushes) {
  each_tile<Lanes>(range, [&](Tile<Lanes>& t, const auto& a, const auto& b, std::size_t k) {
    const auto gaps = core::gaps_now(t.patch, a, b);
    core::each_point(t.patch, [&](int n) { t.gaps[n] = gaps(n); });
    core::forget_slips(t.patch);
    core::fastest_push(t.patch, step, [&](int n) { return t.gaps[n]; }).store(pushes + k * kTileLanes);
    speeds[k] = largest_of(core::fastest_point(t.patch, core::motion_of<Lanes>(t.patch, a, b)));
  });
}

template <typename Lanes>
void warm_start(const TileRange& range) {
  each_tile_moving<Lanes>(range,
                          [](Tile<Lanes>& t, auto& a, auto& b, std::size_t) { core::warm_start(t.patch, a, b); });
}

template <typename Lanes>
void sweep(const TileRange& range, const core::SoftStep& step, const SweepWay& way) {
  each_tile_moving<Lanes>(range, [&](Tile<Lanes>& t, auto& a, auto& b, std::size_t k) {
    if (way.is_one_of_many) {
      if (way.is_first)
        t.way = {};
      else
        core::follow_impulses(t.patch, t.way, way.share);
      core::note_impulses(t.patch, t.way);
    }
    const auto goals = core::goals_of(t.patch, step, [&](int n) { return t.gaps[n]; });
    way.speeds[k] = largest_of(core::solve_patch(t.patch, goals, a, b, step));
    if (way.is_one_of_many) core::squared_change(t.patch, t.way).store(way.changes + k * kTileLanes);
  });
}

template <typename Lanes>
void push_along(const TileRange& range, float share) {
  each_tile_moving<Lanes>(
      range, [&](Tile<Lanes>& t, auto& a, auto& b, std::size_t) { core::push_along(t.patch, t.way, a, b, share); });
}

template <typename Lanes>
void relax(const TileRange& range, const core::SoftStep& step, float* changes) {
  each_tile_moving<Lanes>(range, [&](Tile<Lanes>& t, auto& a, auto& b, std::size_t k) {
    const auto goals = core::goals_after_motion(t.patch, a, b, step);
    core::relax_patch(t.patch, goals, a, b).store(changes + k * kTileLanes);
  });
}

template <typename Lanes>
void end_substep(const TileRange& range) {
  for (std::size_t k = range.first; k < range.last; ++k) {
    core::PatchOf<Lanes>& patch = Tile<Lanes>::at(range.tiles, k).patch;
    core::drop_impacts(patch);
    core::add_to_totals(patch);
  }
}

template <typename Lanes>
constexpr PatchKernels kernels_of(const char* name) {
  return {name,
          sizeof(Tile<Lanes>),
          clear<Lanes>,
          put<Lanes>,
          get<Lanes>,
          begin_sweeps<Lanes>,
          warm_start<Lanes>,
          sweep<Lanes>,
          push_along<Lanes>,
          relax<Lanes>,
          end_substep<Lanes>};
}

}  // namespace broadside::reference::tiles
