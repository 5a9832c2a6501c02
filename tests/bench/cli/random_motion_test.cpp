// Bodies that fly about without gravity, as a user runs and judges them. Before points counted as met whose impulse was
// taken back, `unilateral` failed for the cubes and `energy-growth` for the cylinders. Before the deepest point of a
// cylinder was right where its axis is the normal, `contact-truth` failed with soft steps.
#include "tests/bench/cli/judged_run.hpp"

namespace broadside::tests {
namespace {

TEST(RandomMotion, BreaksNoLaw) {
  holds_all_laws("randommove:cube:60[rigid=1,seed=2]", "octree-cpu", "90");
  holds_all_laws("randommove:capsule:60[rigid=1,seed=2]", "octree-cpu", "60");
  holds_all_laws("randommove:cylinder:60[rigid=1,seed=2]", "octree-cpu", "90");
  holds_all_laws("randommove:stone:60[rigid=1,seed=2]", "octree-cpu", "60");
  holds_all_laws("randommove:cylinder:60[rigid=1,seed=1]", "octree-cpu[contact=soft-step]", "30");
}

}  // namespace
}  // namespace broadside::tests
