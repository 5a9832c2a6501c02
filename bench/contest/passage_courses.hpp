// Scenes with a body so fast that it may pass through another one, and how far it moves a step.
#pragma once

#include <string>
#include <vector>

namespace broadside::bench::contest {

struct PassageRun {
  std::string scene;
  double step_m = 0.0;  // how far the fast body moves a step if nothing stops it
};

struct PassageCourse {
  std::string name;
  std::string what;
  std::vector<PassageRun> runs;  // by falling distance a step, or by rising speed
};

// Fast scenes of the family rigid: at steps of 1/60 to 1/960 s, and a mesh that is dropped at 1 to 200 m/s.
std::vector<PassageCourse> passage_courses();

}  // namespace broadside::bench::contest
