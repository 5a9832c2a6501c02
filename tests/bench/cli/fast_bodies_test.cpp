// A bullet that meets cards, as a user runs and judges it. Before steps of fast bodies were taken in parts,
// `unilateral` failed here.
#include <gtest/gtest.h>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

TEST(FastBodies, BreakNoLaw) {
  const ScratchFolder folder;
  const Ended ran = run_program({"run", "rigid:bullet-through-cards", "--engine", "octree-cpu", "--engine",
                                 "octree-cpu[contact=stiff]", "--out", (folder / "out").string()});
  ASSERT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  for (const char* trace : {"octree-cpu.h5", "octree-cpu+contact=stiff.h5"}) {
    const Ended judged = run_program({"check", (folder / "out" / trace).string()});
    EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
    EXPECT_NE(judged.out.find("passage            pass"), std::string::npos) << judged.out;
  }
}

}  // namespace
}  // namespace broadside::tests
