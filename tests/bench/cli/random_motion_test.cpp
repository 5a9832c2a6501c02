// Bodies that fly about without gravity, as a user runs and judges them. Before points counted as met whose impulse was
// taken back, `unilateral` failed for the cubes and `energy-growth` for the cylinders. Before the deepest point of a
// cylinder was right where its axis is the normal, `contact-truth` failed with soft steps.
#include <gtest/gtest.h>

#include <string>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

void holds_all_laws(const std::string& scene, const std::string& engine, const std::string& frames) {
  SCOPED_TRACE(scene + " " + engine);
  const ScratchFolder folder;
  const std::string out = (folder / "out").string();
  const Ended ran = run_program({"run", scene, "--engine", engine, "--frames", frames, "--out", out});
  ASSERT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const std::string trace = engine == "octree-cpu" ? "octree-cpu.h5" : "octree-cpu+contact=soft-step.h5";
  const Ended judged = run_program({"check", (folder / "out" / trace).string()});
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_NE(judged.out.find("energy-growth      pass"), std::string::npos) << judged.out;
}

TEST(RandomMotion, BreaksNoLaw) {
  holds_all_laws("randommove:cube:60[rigid=1,seed=2]", "octree-cpu", "90");
  holds_all_laws("randommove:capsule:60[rigid=1,seed=2]", "octree-cpu", "60");
  holds_all_laws("randommove:cylinder:60[rigid=1,seed=2]", "octree-cpu", "90");
  holds_all_laws("randommove:stone:60[rigid=1,seed=2]", "octree-cpu", "60");
  holds_all_laws("randommove:cylinder:60[rigid=1,seed=1]", "octree-cpu[contact=soft-step]", "30");
}

}  // namespace
}  // namespace broadside::tests
