#include "reference/rigid_mutants/staged_world.hpp"

#include <utility>

namespace broadside::reference {

core::Status StagedWorld::load(const core::Scene& scene) {
  last_told = {};
  return PlainWorld::load(scene);
}

void StagedWorld::find_points(double h) {
  stages_.find_points != nullptr ? stages_.find_points(*this, h) : PlainWorld::find_points(h);
}

void StagedWorld::solve_impacts(double h) {
  stages_.solve_impacts != nullptr ? stages_.solve_impacts(*this, h) : PlainWorld::solve_impacts(h);
}

void StagedWorld::accelerate(double h) {
  stages_.accelerate != nullptr ? stages_.accelerate(*this, h) : PlainWorld::accelerate(h);
}

void StagedWorld::solve_contacts(double h) {
  stages_.solve_contacts != nullptr ? stages_.solve_contacts(*this, h) : PlainWorld::solve_contacts(h);
}

void StagedWorld::move(double h) {
  stages_.move != nullptr ? stages_.move(*this, h) : PlainWorld::move(h);
}

void StagedWorld::turn(plain::RigidBody& body, double h) {
  stages_.turn != nullptr ? stages_.turn(*this, body, h) : PlainWorld::turn(body, h);
}

void StagedWorld::separate() {
  stages_.separate != nullptr ? stages_.separate(*this) : PlainWorld::separate();
}

void StagedWorld::record(core::FrameRecord& frame) {
  if (stages_.tell == nullptr) return;
  core::FrameRecord sound = frame;
  stages_.tell(*this, frame);
  last_told = std::move(sound);
}

}  // namespace broadside::reference
