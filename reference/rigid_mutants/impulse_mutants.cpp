#include <array>
#include <cmath>
#include <vector>

#include "core/contact.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using plain::cross;
using plain::dot;
using plain::RigidBody;
using plain::SolverPoint;
using plain::Vec;

// Gives the bodies of a point a further impulse. is_told: it is recorded with the point.
void push(StagedWorld& w, SolverPoint& p, Vec impulse, bool is_told = true) {
  const auto give = [&](std::uint32_t i, Vec j) {
    if (core::is_face(i) || w.bodies_[i].is_static()) return;
    RigidBody& b = w.bodies_[i];
    b.v = b.v + b.inverse_mass * j;
    b.angular_momentum = b.angular_momentum + cross(p.at.point - b.x, j);
  };
  give(p.a, impulse);
  give(p.b, -impulse);
  if (is_told) p.total_impulse = p.total_impulse + impulse;
}

Vec tangent_part(const SolverPoint& p) {
  return p.total_impulse - dot(p.total_impulse, p.at.normal) * p.at.normal;
}

// The sound solve, and then one change at each point that carries an impulse.
template <typename Change>
void solve_and(StagedWorld& w, double h, const Change& change) {
  w.sound_solve_contacts(h);
  for (SolverPoint& p : w.points_)
    if (dot(p.total_impulse, p.total_impulse) > 0.0) change(p);
}

template <typename Change>
void with_surface(StagedWorld& w, double h, const Change& change) {
  w.sound_find_points(h);
  for (SolverPoint& p : w.points_) change(p.surface);
}

// Solves all points so that they separate at this speed, whatever their gap.
void solve_for(StagedWorld& w, double (*least_speed)(const SolverPoint&, double h), double h) {
  for (SolverPoint& p : w.points_) p.least_speed = least_speed(p, h);
  plain::solve_velocities(w.points_, w.bodies_, 100);
  for (SolverPoint& p : w.points_) p.finish_solve();
}

std::span<const RigidMutant> impulse_table() {
  static const auto kTable = std::to_array<RigidMutant>({
      {"one-sided-impulses",
       "impulses act on A alone",
       "momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              const std::vector<RigidBody> before = w.bodies_;
              w.sound_solve_impacts(h);
              for (const SolverPoint& p : w.points_)
                if (!core::is_face(p.b)) w.bodies_[p.b].v = before[p.b].v;
            }}},
      {"impulses-twice",
       "velocities change by twice the impulse",
       "momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              const std::vector<RigidBody> before = w.bodies_;
              w.sound_solve_impacts(h);
              for (std::size_t i = 0; i < before.size(); ++i)
                w.bodies_[i].v = w.bodies_[i].v + (w.bodies_[i].v - before[i].v);
            }}},
      {"invents-momentum",
       "bodies that touch gain 1 mm/s upward",
       "momentum",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](const SolverPoint& p) {
                w.bodies_[p.a].v.y += 1e-3 * (w.bodies_[p.a].is_static() ? 0 : 1);
              });
            }}},
      {"loses-momentum",
       "bodies that touch lose a thousandth of their velocity",
       "momentum",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](const SolverPoint& p) { w.bodies_[p.a].v = 0.999 * w.bodies_[p.a].v; });
            }}},
      {"impulses-by-the-other-mass",
       "each body is given the other's change of velocity",
       "momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              const std::vector<RigidBody> before = w.bodies_;
              w.sound_solve_impacts(h);
              const Vec change = w.bodies_[4].v - before[4].v;
              w.bodies_[4].v = before[4].v - (w.bodies_[5].v - before[5].v);
              w.bodies_[5].v = before[5].v - change;
            }}},
      {"contacts-never-turn",
       "impulses change no angular momentum",
       "angular-momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              const std::vector<RigidBody> before = w.bodies_;
              w.sound_solve_impacts(h);
              for (std::size_t i = 0; i < before.size(); ++i)
                w.bodies_[i].angular_momentum = before[i].angular_momentum;
            }}},
      {"torque-from-nowhere",
       "bodies that touch gain angular momentum about the vertical",
       "angular-momentum",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](const SolverPoint& p) {
                if (!w.bodies_[p.a].is_static()) w.bodies_[p.a].angular_momentum.y += 0.05;
              });
            }}},
      {"moments-reversed",
       "the moments of impulses have the wrong sign",
       "angular-momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              const std::vector<RigidBody> before = w.bodies_;
              w.sound_solve_impacts(h);
              for (std::size_t i = 0; i < before.size(); ++i) {
                const Vec l0 = before[i].angular_momentum;
                w.bodies_[i].angular_momentum = l0 - (w.bodies_[i].angular_momentum - l0);
              }
            }}},
      {"arms-from-the-origin",
       "moments are taken about the world's origin",
       "angular-momentum",
       "rigid-mixed",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              w.sound_solve_impacts(h);
              for (const SolverPoint& p : w.points_) {
                RigidBody& a = w.bodies_[p.a];
                a.angular_momentum = a.angular_momentum + 0.1 * cross(a.x, p.total_impulse);
              }
            }}},
      {"mu-halved",
       "friction is half of the scene's",
       "friction-cone",
       "rigid-mixed",
       {.find_points =
            [](StagedWorld& w, double h) {
              with_surface(w, h, [](core::Material& m) { m.mu_static *= 0.5F, m.mu_kinetic *= 0.5F; });
            }}},
      {"mu-doubled",
       "friction is twice the scene's",
       "friction-cone",
       "rigid-mixed",
       {.find_points =
            [](StagedWorld& w, double h) {
              with_surface(w, h, [](core::Material& m) { m.mu_static *= 2.0F, m.mu_kinetic *= 2.0F; });
            }}},
      {"everything-is-ice",
       "there is no friction",
       "friction-cone",
       "rigid-mixed",
       {.find_points =
            [](StagedWorld& w, double h) {
              with_surface(w, h, [](core::Material& m) { m.mu_static = m.mu_kinetic = 0.0F; });
            }}},
      {"friction-reversed",
       "friction pushes sliding bodies along",
       "friction-cone",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](SolverPoint& p) { push(w, p, -2.0 * tangent_part(p)); });
            }}},
      {"friction-sideways",
       "friction acts across the direction of sliding",
       "friction-cone",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](SolverPoint& p) {
                const Vec t = tangent_part(p);
                push(w, p, cross(p.at.normal, t) - t);
              });
            }}},
      {"a-pyramid-undeclared",
       "friction reaches sqrt 2 of the cone",
       "friction-cone",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h, [&w](SolverPoint& p) { push(w, p, 0.41 * tangent_part(p)); });
            }}},
      {"contacts-pull",
       "contacts pull on bodies that separate",
       "friction-cone",
       "rigid-mixed",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_and(w, h,
                        [&w](SolverPoint& p) { push(w, p, -1.01 * dot(p.total_impulse, p.at.normal) * p.at.normal); });
            }}},
      {"restitution-above-one",
       "e = 1.2",
       "energy-growth",
       "rigid-bounce",
       {.solve_impacts =
            [](StagedWorld& w, double h) {
              // (1 + 1.2) / (1 + 0.8) of the impulse.
              w.sound_solve_impacts(h);
              for (SolverPoint& p : w.points_) push(w, p, (2.2 / 1.8 - 1.0) * p.total_impulse);
            }}},
      {"explodes",
       "bodies that rest on each other are thrown apart at 1 m/s",
       "energy-growth",
       "rigid-stack",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_for(
                  w, [](const SolverPoint& p, double) { return p.at.gap < 1e-3 ? 1.0 : -1e3; }, h);
            }}},
      {"corrects-through-velocities",
       "depth is corrected through velocities, which is not declared",
       "energy-growth",
       "rigid-overlap",
       {.solve_contacts =
            [](StagedWorld& w, double h) {
              solve_for(
                  w, [](const SolverPoint& p, double step) { return -p.at.gap / step; }, h);
            }}},
      {"restitution-halved",
       "bodies bounce with half of the scene's e",
       "closed-form",
       "rigid-bounce",
       {.find_points = [](StagedWorld& w,
                          double h) { with_surface(w, h, [](core::Material& m) { m.restitution *= 0.5F; }); }}},
      {"runs-that-differ",
       "sums depend on the run",
       "determinism",
       "rigid-mixed",
       {.accelerate =
            [](StagedWorld& w, double h) {
              w.sound_accelerate(h);
              w.bodies_[0].v.x += 1e-9 * static_cast<double>(w.run());
            }},
       true},
  });
  return kTable;
}

}  // namespace

std::span<const RigidMutant> impulse_mutants() {
  return impulse_table();
}

}  // namespace broadside::reference
