// The kernels over tiles of patches. This text is compiled once for each instruction set.
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

inline constexpr unsigned kAllLanes = (1U << kTileLanes) - 1U;

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
  // Writes the velocities of the moved bodies in `lanes`: bit k is lane k.
  void store(core::SolverBody* bodies, const std::uint32_t (&ids)[kTileLanes], unsigned lanes = kAllLanes) const {
    float* at[kTileLanes];
    for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) at[lane] = reinterpret_cast<float*>(bodies + ids[lane]);
    const unsigned moves = lanes & lanes_of(core::is_moved(*this));
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
  for (core::PatchPointOf<Lanes>& p : t.patch.points)
    p.normal_mass = p.slip_mobility = 1.0F;  // lanes without a patch divide by them
}

// visit(x, y) for every number x of the patches of a tile and the number y of one patch that corresponds to it.
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
    visit(p.slip_mobility, q.slip_mobility);
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

// The numbers of a tile's patches that a sweep changes.
template <typename Lanes>
class PointImpulses {
 public:
  explicit PointImpulses(const core::PatchOf<Lanes>& patch) {
    for (int k = 0; k < patch.count; ++k) {
      const core::PatchPointOf<Lanes>& p = patch.points[k];
      points_[k] = {p.normal_impulse, p.tangent_impulse_1, p.tangent_impulse_2, p.slides};
    }
  }
  // Restores these numbers in the lanes where is_asked is true.
  void restore(const core::TruthOf<Lanes>& is_asked, core::PatchOf<Lanes>& patch) const {
    const core::TruthOf<Lanes> is_not = !is_asked;
    for (int k = 0; k < patch.count; ++k) {
      core::PatchPointOf<Lanes>& p = patch.points[k];
      p.normal_impulse = pick(is_asked, points_[k].normal, p.normal_impulse);
      p.tangent_impulse_1 = pick(is_asked, points_[k].tangent_1, p.tangent_impulse_1);
      p.tangent_impulse_2 = pick(is_asked, points_[k].tangent_2, p.tangent_impulse_2);
      p.slides = (is_asked & points_[k].slides) | (is_not & p.slides);
    }
  }

 private:
  struct Point {
    Lanes normal;
    Lanes tangent_1;
    Lanes tangent_2;
    core::TruthOf<Lanes> slides;
  };
  Point points_[core::kManifoldPoints];
};

// The lanes that have a stirred body.
template <typename Lanes>
unsigned stirred_lanes(const Tile<Lanes>& t, const StirredSweep& sweep) {
  unsigned lanes = 0;
  for (std::uint32_t lane = 0; lane < kTileLanes; ++lane)
    if (sweep.stirred[t.a[lane]] >= sweep.number || sweep.stirred[t.b[lane]] >= sweep.number) lanes |= 1U << lane;
  return lanes;
}

// Stirs the moved bodies of these lanes for the next sweep.
template <typename Lanes>
void stir(const Tile<Lanes>& t, const LaneBody<Lanes>& a, const LaneBody<Lanes>& b, unsigned lanes,
          const StirredSweep& sweep) {
  const unsigned moves_a = lanes & lanes_of(core::is_moved(a));
  const unsigned moves_b = lanes & lanes_of(core::is_moved(b));
  for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) {
    if ((moves_a >> lane & 1U) != 0) sweep.stirred[t.a[lane]] = sweep.number + 1;
    if ((moves_b >> lane & 1U) != 0) sweep.stirred[t.b[lane]] = sweep.number + 1;
  }
}

// The impulses of `followers` follow their last direction. The other lanes, which these sweeps have not visited before,
// begin without a direction.
template <typename Lanes>
void follow(Tile<Lanes>& t, unsigned followers, float share) {
  const core::TruthOf<Lanes> begins = core::TruthOf<Lanes>::of_lanes(~followers);
  if (followers != 0) {
    const PointImpulses<Lanes> before(t.patch);
    core::follow_impulses(t.patch, t.way, share);
    before.restore(begins, t.patch);
  }
  for (auto& of_point : t.way.way)
    for (Lanes& x : of_point) x = pick(begins, Lanes(0.0F), x);
  core::note_impulses(t.patch, t.way);
}

template <typename Lanes>
void relax_stirred(const TileRange& range, const core::SoftStep& step, const StirredSweep& sweep) {
  const bool has_directions = core::has_directions(step);
  for (std::size_t k = range.first; k < range.last; ++k) {
    Tile<Lanes>& t = Tile<Lanes>::at(range.tiles, k);
    float* const changes = sweep.changes + k * kTileLanes;
    Lanes(0.0F).store(changes);
    sweep.largest[k] = 0.0F;
    const unsigned visited = sweep.followers[k] | stirred_lanes(t, sweep);
    if (visited == 0) continue;
    if (has_directions) follow(t, sweep.followers[k], sweep.share);
    LaneBody<Lanes> a(range.bodies, t.a);
    LaneBody<Lanes> b(range.bodies, t.b);
    const core::TruthOf<Lanes> is_visited = core::TruthOf<Lanes>::of_lanes(visited);
    const PointImpulses<Lanes> before(t.patch);
    const Lanes sizes =
        pick(is_visited, core::relax_patch(t.patch, core::goals_after_motion(t.patch, a, b, step), a, b), Lanes(0.0F));
    before.restore(!is_visited, t.patch);
    a.store(range.bodies, t.a, visited);
    b.store(range.bodies, t.b, visited);
    stir(t, a, b, lanes_of(sizes > Lanes(sweep.done_m_s)), sweep);
    sweep.largest[k] = largest_of(sizes);
    if (!has_directions) continue;
    sweep.followers[k] = static_cast<std::uint8_t>(visited);
    pick(is_visited, core::squared_change(t.patch, t.way), Lanes(0.0F)).store(changes);
  }
}

template <typename Lanes>
void push_stirred(const TileRange& range, const StirredSweep& sweep) {
  for (std::size_t k = range.first; k < range.last; ++k) {
    if (sweep.followers[k] == 0) continue;
    const Tile<Lanes>& t = Tile<Lanes>::at(range.tiles, k);
    LaneBody<Lanes> a(range.bodies, t.a);
    LaneBody<Lanes> b(range.bodies, t.b);
    core::push_along(t.patch, t.way, a, b, sweep.share);
    a.store(range.bodies, t.a, sweep.followers[k]);
    b.store(range.bodies, t.b, sweep.followers[k]);
  }
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
          relax_stirred<Lanes>,
          push_stirred<Lanes>,
          end_substep<Lanes>};
}

}  // namespace broadside::reference::tiles
