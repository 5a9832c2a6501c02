#include <array>
#include <cmath>

#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using plain::cross;
using plain::Mat;
using plain::RigidBody;
using plain::transposed;
using plain::Vec;

Vec gravity_of(const StagedWorld& w) {
  const core::Vec3 g = w.scene().gravity_m_s2;
  return {g.x, g.y, g.z};
}

template <typename Change>
void for_moving(StagedWorld& w, const Change& change) {
  for (RigidBody& b : w.bodies_)
    if (!b.is_static()) change(b);
}

// The angular momentum that gives the body this angular velocity.
Vec momentum_for(const RigidBody& b, Vec spin) {
  const Mat r = b.rotation();
  return r * (b.inertia * (transposed(r) * spin));
}

// Leaves out the gyroscopic torque: after a turn the body keeps its angular velocity instead of its angular momentum.
void keep_spin(RigidBody& b, Vec spin) {
  b.angular_momentum = momentum_for(b, spin);
}

std::span<const RigidMutant> flight_table() {
  static const auto kTable = std::to_array<RigidMutant>({
      {"does-nothing",
       "no body ever moves",
       "ballistic",
       "rigid-mixed",
       {.solve_impacts = [](StagedWorld&, double) {},
        .accelerate = [](StagedWorld&, double) {},
        .solve_contacts = [](StagedWorld&, double) {},
        .move = [](StagedWorld&, double) {},
        .separate = [](StagedWorld&) {}}},
      {"gravity-plus-tenth",
       "gravity + 10 %",
       "ballistic",
       "rigid-mixed",
       {.accelerate = [](StagedWorld& w,
                         double h) { for_moving(w, [&](RigidBody& b) { b.v = b.v + (1.1 * h) * gravity_of(w); }); }}},
      {"gravity-ninety-nine-percent",
       "gravity - 1 %",
       "ballistic",
       "rigid-mixed",
       {.accelerate = [](StagedWorld& w,
                         double h) { for_moving(w, [&](RigidBody& b) { b.v = b.v + (0.99 * h) * gravity_of(w); }); }}},
      {"gravity-by-mass",
       "gravity acts as a force of one size on every body",
       "ballistic",
       "rigid-mixed",
       {.accelerate =
            [](StagedWorld& w, double h) {
              for_moving(w, [&](RigidBody& b) { b.v = b.v + (h * b.inverse_mass) * gravity_of(w); });
            }}},
      {"linear-damping",
       "velocities lose 0.1 % a step, although the scene has no damping",
       "ballistic",
       "rigid-mixed",
       {.accelerate =
            [](StagedWorld& w, double h) {
              w.sound_accelerate(h);
              for_moving(w, [](RigidBody& b) { b.v = 0.999 * b.v; });
            }}},
      {"energy-plus-a-thousandth",
       "energy + 0.1 % a frame",
       "ballistic",
       "rigid-mixed",
       {.accelerate =
            [](StagedWorld& w, double h) {
              w.sound_accelerate(h);
              for_moving(w, [](RigidBody& b) {
                b.v = std::sqrt(1.001) * b.v;
                b.angular_momentum = std::sqrt(1.001) * b.angular_momentum;
              });
            }}},
      {"drifts-sideways",
       "free bodies drift by 0.1 mm a step",
       "ballistic",
       "rigid-mixed",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              for_moving(w, [](RigidBody& b) { b.x.z += 1e-4; });
            }}},
      {"teleports",
       "once, a body jumps by 10 cm",
       "ballistic",
       "rigid-mixed",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              if (w.step_number() == 5) w.bodies_[0].x.x += 0.1;
            }}},
      {"half-step",
       "positions move for half of the step",
       "ballistic",
       "rigid-mixed",
       {.move =
            [](StagedWorld& w, double h) {
              for_moving(w, [&](RigidBody& b) {
                b.x = b.x + (0.5 * h) * b.v;
                w.sound_turn(b, h);
              });
            }}},
      {"swaps-two-bodies",
       "two bodies are swapped for a frame",
       "ballistic",
       "rigid-mixed",
       {.tell =
            [](StagedWorld&, core::FrameRecord& frame) {
              if (frame.step == 6) std::swap(frame.wide.position[0], frame.wide.position[1]);
            }}},
      {"velocity-cap",
       "velocities are clipped at 1 m/s",
       "ballistic",
       "rigid-mixed",
       {.accelerate =
            [](StagedWorld& w, double h) {
              w.sound_accelerate(h);
              for_moving(w, [](RigidBody& b) {
                for (int k = 0; k < 3; ++k) b.v[k] = std::clamp(b.v[k], -1.0, 1.0);
              });
            }}},
      {"float16-positions",
       "positions are rounded to 11 bits",
       "ballistic",
       "rigid-mixed",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              for_moving(w, [](RigidBody& b) {
                for (int k = 0; k < 3; ++k) b.x[k] = std::nearbyint(b.x[k] * 1024.0) / 1024.0;
              });
            }}},
      {"half-rate",
       "orientation at half rate",
       "turning",
       "rigid-mixed",
       {.turn = [](StagedWorld& w, RigidBody& b, double h) { w.sound_turn(b, 0.5 * h); }}},
      {"turns-backward",
       "orientations turn against the angular velocity",
       "turning",
       "rigid-mixed",
       {.turn = [](StagedWorld& w, RigidBody& b, double h) { w.sound_turn(b, -h); }}},
      {"frozen-orientation",
       "orientations never change",
       "turning",
       "rigid-mixed",
       {.turn = [](StagedWorld&, RigidBody&, double) {}}},
      {"frozen-at-a-million",
       "orientations never change, at 1e6 rad/s",
       "turning",
       "rigid-million",
       {.turn = [](StagedWorld&, RigidBody&, double) {}}},
      {"turns-about-body-axes",
       "the angular velocity is taken for one in body axes",
       "turning",
       "rigid-mixed",
       {.turn =
            [](StagedWorld&, RigidBody& b, double h) {
              const Vec spin = b.rotation() * b.angular_velocity();
              b.q = plain::normalized(plain::moved(b.q, b.q, spin, h));
            }}},
      {"turns-two-percent-fast",
       "orientation 2 % too fast",
       "turning",
       "rigid-mixed",
       {.turn = [](StagedWorld& w, RigidBody& b, double h) { w.sound_turn(b, 1.02 * h); }}},
      {"no-gyroscopic-term",
       "the angular velocity is conserved, not the angular momentum",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              const Vec spin = b.angular_velocity();
              w.sound_turn(b, h);
              keep_spin(b, spin);
            }}},
      {"gyroscopic-term-reversed",
       "the gyroscopic torque has the wrong sign",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              const Vec spin = b.angular_velocity();
              const Vec torque = cross(spin, b.angular_momentum);
              w.sound_turn(b, h);
              keep_spin(b, spin);
              b.angular_momentum = b.angular_momentum + h * torque;
            }}},
      {"spin-up",
       "w + 1 % a second",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              w.sound_turn(b, h);
              b.angular_momentum = (1.0 + 0.01 * h) * b.angular_momentum;
            }}},
      {"angular-damping",
       "spins lose 1 % a second, although the scene has no damping",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              w.sound_turn(b, h);
              b.angular_momentum = (1.0 - 0.01 * h) * b.angular_momentum;
            }}},
      {"inertia-of-a-ball",
       "a sphere's inertia for a brick",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              const double mean = (b.inertia.row[0].x + b.inertia.row[1].y + b.inertia.row[2].z) / 3.0;
              const Vec spin = b.angular_velocity();
              RigidBody ball = b;
              ball.inertia = {{Vec{mean, 0, 0}, Vec{0, mean, 0}, Vec{0, 0, mean}}};
              ball.inverse_inertia = plain::inverse(ball.inertia);
              ball.angular_momentum = mean * spin;
              w.sound_turn(ball, h);
              b.q = ball.q;
              keep_spin(b, ball.angular_velocity());
            }}},
      {"inertia-axes-swapped",
       "two principal moments are swapped",
       "gyroscopic",
       "rigid-mixed",
       {.turn =
            [](StagedWorld& w, RigidBody& b, double h) {
              const Vec spin = b.angular_velocity();
              RigidBody other = b;
              std::swap(other.inertia.row[0].x, other.inertia.row[1].y);
              other.inverse_inertia = plain::inverse(other.inertia);
              other.angular_momentum = momentum_for(other, spin);
              w.sound_turn(other, h);
              b.q = other.q;
              keep_spin(b, other.angular_velocity());
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const RigidMutant> flight_mutants() {
  return flight_table();
}

std::unique_ptr<core::Dynamics> make_rigid_mutant(const RigidMutant& mutant, std::uint64_t run) {
  if (mutant.is_of_pipeline) return std::make_unique<StagedPipeline>(mutant.turning, run);
  return std::make_unique<StagedWorld>(mutant.stages, run);
}

}  // namespace broadside::reference
