// A serial simulation in float64 of boxes, spheres and convex meshes that turn, written to be simple and right: a
// reference, and the engine whose stages mutants replace one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/dynamics.hpp"
#include "core/scene/scene.hpp"
#include "reference/plain_rigid/rigid_body.hpp"
#include "reference/plain_rigid/solver.hpp"

namespace broadside::reference::plain {

struct WorldOptions {
  std::uint32_t iterations = 300;  // at most: passes of the contact solver
};

// One step of h:
//   1. points where bodies touch or may touch within h, at the poses of the start;
//   2. impacts: bodies that meet faster than the scene's threshold rebound, before gravity acts; then points are
//      added that the struck bodies may now reach;
//   3. gravity, then impulses that keep bodies from moving into each other (speculative: the gap may close, no more);
//   4. positions move with the mean velocity where nothing touched, so that free flight is exact, and with the last
//      velocity where something did; orientations by the classical Runge-Kutta method, angular momentum constant;
//   5. bodies that are deeper than the slop are moved apart.
class PlainWorld : public core::Dynamics {
 public:
  explicit PlainWorld(WorldOptions options) : options_(options) {}

  core::Status load(const core::Scene& scene) override;
  core::Status step(float dt_s) override;
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel level) override;
  [[nodiscard]] std::uint32_t groups() const override;
  [[nodiscard]] std::vector<core::Counter> counters() const override;

 protected:
  // The stages, in order. A mutant replaces one.
  virtual void find_points(double h);
  virtual void solve_impacts(double h);
  virtual void accelerate(double h);
  virtual void solve_contacts(double h);
  virtual void move(double h);
  virtual void turn(RigidBody& body, double step);
  virtual void separate();
  // Called last; may change what is recorded.
  virtual void record(core::FrameRecord&) {}

  [[nodiscard]] const core::Scene& scene() const { return *scene_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  // The world's box of a body's shape at its present pose.
  [[nodiscard]] core::Box box_of(const RigidBody& body) const;

  std::vector<RigidBody> bodies_;
  std::vector<SolverPoint> points_;
  WorldOptions options_;

 private:
  void add_pair(std::uint32_t a, std::uint32_t b, double h);
  void add_faces(std::uint32_t a, double h);
  void find_points_of_struck(double h);
  static void turn_part(RigidBody& body, double h);
  void begin_record();
  void start_warm();
  void carry();
  // Acceleration by gravity and wrenches, m/s^2; zero for a static body.
  [[nodiscard]] Vec pull(const RigidBody& body) const;
  // How far any point of the body may come in h, m, with what gravity and wrenches add.
  [[nodiscard]] double farthest(const RigidBody& body, double h) const;

  // The impulses of a point of the last step, and where that point was on A.
  struct Carried {
    std::uint32_t a;
    std::uint32_t b;
    Vec local;  // m, relative to the center of mass, in A's axes
    double normal_impulse;
    Vec friction_impulse;
  };

  const core::Scene* scene_ = nullptr;
  std::vector<Carried> carried_;
  std::uint64_t steps_ = 0;
  std::uint64_t sweeps_ = 0;
  std::vector<std::uint8_t> is_touched_;
  std::vector<Vec> velocity_before_gravity_;
  // The states and boxes at the start of the step, and its points.
  core::FrameRecord detected_;
  std::vector<core::ContactPoint> recorded_;
};

}  // namespace broadside::reference::plain
