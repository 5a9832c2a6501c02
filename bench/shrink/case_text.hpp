// A small scene as the source of a GoogleTest case.
#pragma once

#include <string>

#include "core/scene/scene.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

struct CaseFacts {
  std::string command;    // the command that made it
  std::string engine;     // "octree-cpu[levels=A]"
  std::string validator;  // the law that the engine breaks in the scene
  std::string against;    // the engine that it was compared with; empty: none, or a second run
  core::Verdict verdict;
};

// A source file that needs nothing but this repository. It builds the scene number by number, with enough digits to
// name every float, runs the engine, and expects that the validator does not object. The test fails as long as the
// engine is wrong.
std::string case_text(const core::Scene& scene, const CaseFacts& facts);

}  // namespace broadside::bench
