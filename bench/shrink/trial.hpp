// One trial of the shrinker: does this engine, on this scene, get this verdict?
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

// The question that is asked about every scene that is tried.
struct Question {
  std::string validator;
  CellSpec engine;
  // The engine to compare with, for validators that compare; none: a second run of the same engine.
  std::optional<CellSpec> against;
};

struct TrialAnswer {
  core::Verdict verdict;
  std::vector<core::Body> end;  // the bodies at the end of the run
};

// Runs all frames of the scene and judges them with this one validator. Engines made of other people's libraries run in
// a child process, so that an abort becomes an error here and does not end this program. Errors: an unknown validator,
// an engine that refuses the scene or fails.
core::Result<TrialAnswer> ask(const Question& question, const core::Scene& scene);

// The same for test cases: engine and against as on the command line, "octree-cpu[levels=A]"; against may be empty.
core::Result<core::Verdict> judge_engine(const core::Scene& scene, std::string_view engine, std::string_view validator,
                                         std::string_view against = {});

}  // namespace broadside::bench
