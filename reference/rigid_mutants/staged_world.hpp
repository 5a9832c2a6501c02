// plain-rigid with its stages as a table of functions; a wrong engine replaces one of them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/frame.hpp"
#include "reference/plain_rigid/plain_world.hpp"

namespace broadside::reference {

class StagedWorld;

// Null: plain-rigid's own stage.
struct RigidStages {
  void (*find_points)(StagedWorld&, double h) = nullptr;
  void (*solve_impacts)(StagedWorld&, double h) = nullptr;
  void (*accelerate)(StagedWorld&, double h) = nullptr;
  void (*solve_contacts)(StagedWorld&, double h) = nullptr;
  void (*move)(StagedWorld&, double h) = nullptr;
  void (*turn)(StagedWorld&, plain::RigidBody&, double h) = nullptr;
  void (*separate)(StagedWorld&) = nullptr;
  // Changes what is recorded of the frame, and nothing else.
  void (*tell)(StagedWorld&, core::FrameRecord&) = nullptr;
};

// With default stages: plain-rigid, bit for bit.
class StagedWorld final : public plain::PlainWorld {
 public:
  // run: 0, 1, ...: lets a mutant differ from run to run.
  explicit StagedWorld(const RigidStages& stages, std::uint64_t run = 0)
      : PlainWorld(plain::WorldOptions{}), stages_(stages), run_(run) {}

  core::Status load(const core::Scene& scene) override;
  [[nodiscard]] std::uint64_t run() const { return run_; }
  // Number of the step that is being computed, from 1.
  [[nodiscard]] std::uint64_t step_number() const { return steps() + 1; }

  // The right stages, which a replaced one may call, and the data that they work on.
  void sound_find_points(double h) { PlainWorld::find_points(h); }
  void sound_solve_impacts(double h) { PlainWorld::solve_impacts(h); }
  void sound_accelerate(double h) { PlainWorld::accelerate(h); }
  void sound_solve_contacts(double h) { PlainWorld::solve_contacts(h); }
  void sound_move(double h) { PlainWorld::move(h); }
  void sound_turn(plain::RigidBody& body, double h) { PlainWorld::turn(body, h); }
  void sound_separate() { PlainWorld::separate(); }
  using PlainWorld::bodies_;
  using PlainWorld::box_of;
  using PlainWorld::points_;
  using PlainWorld::scene;
  // The last recorded frame, for stages that lag behind.
  core::FrameRecord last_told;

 protected:
  void find_points(double h) override;
  void solve_impacts(double h) override;
  void accelerate(double h) override;
  void solve_contacts(double h) override;
  void move(double h) override;
  void turn(plain::RigidBody& body, double h) override;
  void separate() override;
  void record(core::FrameRecord& frame) override;

 private:
  RigidStages stages_;
  std::uint64_t run_;
};

}  // namespace broadside::reference
