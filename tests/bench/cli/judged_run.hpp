// A run of the candidate as a user makes and judges it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {

// engine: octree-cpu, alone or with soft steps.
inline void holds_all_laws(const std::string& scene, const std::string& engine, const std::string& frames) {
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

}  // namespace broadside::tests
