// Causes of laws that are broken at another step than the scene's own, and hold at the scene's own.
#include <array>

#include "bench/contest/blamed_law.hpp"
#include "bench/contest/known_causes.hpp"

namespace broadside::bench::contest {
namespace {

struct StepRow : BlamedLaw {
  std::string_view step;  // "1/60"; empty = any but the scene's own
  std::string_view cause;
};

// A body that falls 1 m reaches 4.4 m/s, which is 7 cm in 1/60 s.
constexpr std::string_view kFallen = "it does not stand, and a body that falls sinks in by its speed times the step";
constexpr std::string_view kThrough =
    "detection at steps alone: a body that moves 0.3 m a step is first detected inside another";
constexpr std::string_view kThinNeedle =
    "rounding of a thin needle's inverse inertia, which the law does not allow for";
constexpr std::string_view kTenAreFew = "ten iterations are too few at 1/60 s: with 50 the box stands";
constexpr std::string_view kFourAreFew = "four iterations are too few at 1/60 s: with 16 the box stands";
constexpr std::string_view kPgsTips = "with ePGS the box tips at 1/60 s: with eTGS, or at 1/240 s, it stands";
constexpr std::string_view kThrownUp =
    "a contact point far outside the boxes throws them up (findings/mujoco_far_point.toml)";
constexpr std::string_view kTwoSteps =
    "springs with a time constant of two steps are too coarse: with the same 0.033 s at 1/240 s the box stands";

constexpr std::array kStepRows{
    StepRow{"octree-cpu", "rest", "rigid:arch:25", "1/60",
            "our engine has too few substeps: with 16 the stones stand at 1/60 s too"},
    StepRow{"plain-rigid", "rest", "rigid:arch:25", "1/60",
            "our engine: 300 iterations are too few at 1/60 s: with 3,000 the stones stand"},
    StepRow{"plain-rigid", "rest", "rigid:overhang:", "1/60",
            "our engine: 300 iterations are too few: with 3,000 the books stand"},
    StepRow{"ode-world", "rest", "rigid:incline:stick", "1/60",
            "twenty iterations are too few: with 500 the box rests"},
    StepRow{"jolt", "rest", "rigid:stack:5", "1/30",
            "ten velocity iterations are too few at 1/30 s: with 200 the cubes stand"},
    StepRow{"bullet-world", "penetration", "rigid:stack:5", "1/30", kFallen},
    StepRow{"", "penetration", "rigid:arch:", "1/60", kFallen},
    StepRow{"", "penetration", "rigid:overhang:", "1/60", kFallen},
    StepRow{"rapier", "penetration", "rigid:stack:1000-on-1", "1/30",
            "four iterations do not carry a mass ratio of 1,000 at 1/30 s: with 16 this law holds"},
    StepRow{"rapier", "rest", "rigid:stack:5", "1/30",
            "four iterations are too few at 1/30 s: with 16 the cubes stand"},
    StepRow{"rapier", "rest", "rigid:tip:", "1/60", kFourAreFew},
    StepRow{"rapier", "ballistic", "rigid:bounce", "",
            "contacts push before bodies touch: with a prediction distance of zero it holds"},
    StepRow{"cannon", "rest", "rigid:tip:", "1/60", kTenAreFew},
    StepRow{"physx", "rest", "rigid:tip:", "1/60", kPgsTips},
    StepRow{"physx", "energy-growth", "rigid:bullet-through-cards", "",
            "the correction of depth leaves speed behind (findings/depth_to_speed.toml): with eTGS this law holds"},
    StepRow{"", "penetration", "rigid:bullet-through-cards", "", kThrough},
    StepRow{"mujoco", "energy-growth", "rigid:tip:incline-stands", "1/60", kThrownUp},
    StepRow{"mujoco", "energy-growth", "rigid:stack:5", "1/240",
            "a corner that is deep by a third of the cubes' size, for one step (mujoco 3476)"},
    StepRow{"mujoco", "rest", "rigid:stack:5", "1/240",
            "a corner that is deep by a third of the cubes' size, for one step (mujoco 3476)"},
    StepRow{"mujoco", "rest", "rigid:tip:", "1/60", kTwoSteps},
    StepRow{"dart-world", "closed-form", "rigid:incline:slide", "",
            "FCL on meshes: boxes get horizontal normals and points far away"},
    StepRow{"ode-world", "energy-growth", "rigid:needle-through-plate", "", kThinNeedle},
    StepRow{"ode-world[solver=dantzig", "energy-growth", "rigid:stack:1000-on-1", "1/240",
            "dWorldStep reports LCP internal errors, here in 17 steps, and goes on with impulses that are no solution"},
};

}  // namespace

std::string_view known_cause_at_step(std::string_view engine, std::string_view law, std::string_view scene) {
  const std::size_t at = scene.find('@');
  if (at == std::string_view::npos) return {};
  const std::string_view step = scene.substr(at + 1);
  for (const StepRow& row : kStepRows)
    if (row.covers(engine, law, scene) && (row.step.empty() || row.step == step)) return row.cause;
  return {};
}

}  // namespace broadside::bench::contest
