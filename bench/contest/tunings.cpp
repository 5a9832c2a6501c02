#include "bench/contest/tunings.hpp"

#include <algorithm>
#include <array>

namespace broadside::bench::contest {
namespace {

constexpr std::array<Tuning, 12> kTunings{{
    {"octree-cpu", "", "its default", "ours: reference/README.md"},
    {"plain-rigid", "", "its default", "ours: reference/README.md"},
    {"bullet-world", "bullet-world[iterations=50]", "50 iterations of the solver instead of 10",
     "Bullet's own physics server, PhysicsServerCommandProcessor.cpp, which PyBullet runs on"},
    {"ode-world", "ode-world[tuning=recommended]", "a surface layer of 0.001 m",
     "ODE's manual, dWorldSetContactSurfaceLayer: it can help prevent jittering"},
    {"dart-world", "", "meshes for primitive shapes too, which is the default",
     "FCLCollisionDetector::setPrimitiveShapeType, whose warning recommends it for dynamics"},
    {"mujoco-world", "mujoco-world[tuning=recommended]",
     "elliptic cones, an impedance ratio above 1 (here 10), several points of convex bodies",
     "MuJoCo's manual, Modeling: cone, impratio, multiccd"},
    {"simbody-world[tuning=shipped]", "simbody-world",
     "a tighter accuracy for results that count (here 1e-8), and a smaller slip speed",
     "Simbody, Integrator::setAccuracy and CompliantContactSubsystem::setTransitionVelocity; no number is named"},
    {"jolt", "jolt[tuning=1]", "one collision step per 1/60 s, rounded up: as shipped where a step is 1/60 s or less",
     "Jolt's HelloWorld.cpp and PhysicsSystem::Update"},
    {"rapier", "rapier[iterations=16]", "more solver iterations where accuracy counts (here 16 instead of 4)",
     "Rapier's user guide, Integration parameters; no number is named"},
    {"mujoco3", "mujoco3[tuning=1]", "as for mujoco-world", "MuJoCo's manual, Modeling: cone, impratio, multiccd"},
    {"cannon", "cannon[iterations=50]", "more iterations of the solver (here 50 instead of 10)",
     "cannon-es, GSSolver.iterations: the more, the more correct; no number is named"},
    {"physx", "physx[tuning=1]", "the solver eTGS instead of ePGS",
     "PhysX 5.6, PxSolverType: better convergence, large mass ratios"},
}};

}  // namespace

std::span<const Tuning> tunings() {
  return kTunings;
}

bool is_recommended(std::string_view label) {
  return std::any_of(kTunings.begin(), kTunings.end(),
                     [label](const Tuning& t) { return !t.recommended.empty() && t.recommended == label; });
}

}  // namespace broadside::bench::contest
